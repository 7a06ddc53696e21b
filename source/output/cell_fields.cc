#include <supple/output/cell_fields.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  CellFields::CellFields(const Configuration &configuration, const ElasticForce &elastic)
  {
    const Body &body = configuration.body;
    for (auto *const field : {&volume_ratio, &von_mises_stress, &rotation_angle, &pressure})
      field->resize(body.mesh.parts->n_cells);
    const std::vector<CellState> states = elastic.states(configuration);
    for (std::size_t c = 0; c < states.size(); ++c)
      {
        const unsigned int cell = body.cell_index[c];
        volume_ratio[cell]      = states[c].volume_ratio;
        von_mises_stress[cell]  = states[c].von_mises_stress;
        rotation_angle[cell]    = states[c].rotation_angle;
        pressure[cell]          = states[c].pressure;
      }
  }


  bool
  CellFields::finite() const
  {
    for (const auto &[name, values] : named())
      if (!std::all_of(values->begin(), values->end(), [](const float value) {
            return std::isfinite(value);
          }))
        return false;
    return true;
  }


  std::array<std::pair<const char *, const std::vector<float> *>, 4>
  CellFields::named() const
  {
    return {{{"volume_ratio", &volume_ratio},
             {"von_mises_stress", &von_mises_stress},
             {"rotation_angle", &rotation_angle},
             {"pressure", &pressure}}};
  }
} // namespace Supple
