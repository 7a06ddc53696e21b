#include <supple/mechanics/configuration.h>

#include <supple/base/gather.h>

#include <nlohmann/json.hpp>

#include <functional>
#include <stdexcept>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** Numbers of a cell that are spread over packs: pack(batch, k) is number k of its cells. */
    using PackOf = std::function<Pack &(std::size_t batch, unsigned int k)>;


    /** The numbers of all cells, cell by cell of the whole mesh; on the first process. */
    std::vector<double>
    gathered(const Body &body, const unsigned int n_numbers, const PackOf &pack)
    {
      std::vector<double> own;
      for (std::size_t c = 0; c < body.cell_nodes.size(); ++c)
        if (body.cell_owned[c])
          {
            own.push_back(body.serial_cell[c]);
            for (unsigned int k = 0; k < n_numbers; ++k)
              own.push_back(pack(c / n_lanes, k)[c % n_lanes]);
          }
      const std::vector<double> all = gathered_on_first(own, body.mesh.communicator);
      if (all.empty())
        return {};
      std::vector<double> values(n_numbers * static_cast<std::size_t>(body.mesh.n_cells));
      for (std::size_t at = 0; at < all.size(); at += 1 + n_numbers)
        std::copy_n(&all[at + 1], n_numbers, &values[n_numbers * std::size_t(all[at])]);
      return values;
    }


    void
    scatter(const Body &body,
            const std::vector<double> &values,
            const unsigned int n_numbers,
            const PackOf &pack)
    {
      if (values.size() != n_numbers * static_cast<std::size_t>(body.mesh.n_cells))
        throw std::out_of_range("values of cells of another mesh");
      for (std::size_t c = 0; c < body.cell_nodes.size(); ++c)
        for (unsigned int k = 0; k < n_numbers; ++k)
          pack(c / n_lanes, k)[c % n_lanes] =
            values[n_numbers * static_cast<std::size_t>(body.serial_cell[c]) + k];
    }


    /** Of a cell at each of its points. */
    PackOf
    entries_of(CellRotations::List &rotations, const unsigned int n_points)
    {
      return [&rotations, n_points](const std::size_t b, const unsigned int k) -> Pack & {
        return rotations[n_points * b + k / 9].entries[k % 9];
      };
    }


    PackOf
    numbers_of(std::vector<Pack> &internal, const unsigned int n)
    {
      return [&internal, n](const std::size_t b, const unsigned int k) -> Pack & {
        return internal[n * b + k];
      };
    }
  } // namespace


  Configuration::Configuration(const Body &body, const Law &law, const bool has_velocity)
    : body(body)
    , internal(body.cells->n_batches() * law.n_internal_variables(), Pack(0.))
    , patches(body.make_patches(law.is_linear()))
    , law(law)
  {
    body.initialize(state.displacement);
    if (has_velocity)
      body.initialize(state.velocity);
    start          = state;
    start_internal = internal;
  }


  std::vector<Vector *>
  Configuration::vectors()
  {
    if (state.has_velocity())
      return {&state.displacement, &state.velocity};
    return {&state.displacement};
  }


  void
  Configuration::update_rotations(Effort &effort)
  {
    if (law.is_linear())
      return;
    const PhaseTimer timer(effort, Phase::rotations);
    const GhostValues values(state.displacement);
    if (law.has_rotations())
      {
        law.update_rotations(values.data(), rotations.current);
        effort.rotations_computed += body.cell_nodes.size();
      }
    if (patches)
      patches->update(rotations.current, values.data());
  }


  void
  Configuration::keep_for_tangent()
  {
    rotations.kept = rotations.current;
    if (patches)
      patches->keep();
  }


  void
  Configuration::begin_step(const double time)
  {
    passage        = {time, time, 1.};
    start          = state;
    start_internal = internal;
    in_step        = true;
  }


  void
  Configuration::accept()
  {
    in_step = false;
  }


  void
  Configuration::reject(Effort &effort)
  {
    AssertThrow(in_step, ExcMessage("no step was begun"));
    passage  = {passage.from, passage.from, 1.};
    state    = start;
    internal = start_internal;
    update_rotations(effort);
  }


  nlohmann::json
  Configuration::save_cells() const
  {
    nlohmann::json saved = nlohmann::json::object();
    if (CellRotations::List kept = rotations.kept; !kept.empty())
      saved["kept_rotations"] =
        gathered(body, 9 * body.cells->n_points(), entries_of(kept, body.cells->n_points()));
    if (const unsigned int n = law.n_internal_variables(); n > 0)
      {
        std::vector<Pack> values    = internal;
        saved["internal_variables"] = gathered(body, n, numbers_of(values, n));
      }
    return saved;
  }


  void
  Configuration::load_cells(const nlohmann::json &saved, Effort &effort)
  {
    rotations.kept.clear();
    if (saved.contains("kept_rotations"))
      {
        const unsigned int n_points = body.cells->n_points();
        rotations.kept.assign(n_points * body.cells->n_batches(), Matrix3<Pack>::identity());
        scatter(body,
                saved.at("kept_rotations"),
                9 * n_points,
                entries_of(rotations.kept, n_points));
      }
    if (const unsigned int n = law.n_internal_variables(); n > 0)
      scatter(body, saved.at("internal_variables"), n, numbers_of(internal, n));
    begin_step(passage.to);
    accept();
    update_rotations(effort);
  }
} // namespace Supple
