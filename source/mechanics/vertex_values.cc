#include <supple/mechanics/vertex_values.h>

#include <supple/base/gather.h>

#include <algorithm>
#include <stdexcept>

namespace Supple
{
  std::vector<double>
  gathered_by_vertex(const Body &body, const double *const own)
  {
    std::vector<double> numbered;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      {
        numbered.push_back(body.serial_vertex[node]);
        numbered.insert(numbered.end(), own + 3 * node, own + 3 * node + 3);
      }
    const std::vector<double> all = gathered_on_first(numbered, body.mesh.communicator);
    std::vector<double> values(3 * std::size_t(body.mesh.n_serial_vertices()));
    for (std::size_t k = 0; k < all.size(); k += 4)
      std::copy_n(&all[k + 1], 3, &values[3 * static_cast<std::size_t>(all[k])]);
    return values;
  }


  void
  scatter_by_vertex(const Body &body, const std::vector<double> &values, double *const own)
  {
    if (values.size() != 3 * std::size_t(body.mesh.n_serial_vertices()))
      throw std::out_of_range("values of vertices of another mesh");
    for (unsigned int node = 0; node < body.n_owned; ++node)
      std::copy_n(&values[3 * static_cast<std::size_t>(body.serial_vertex[node])],
                  3,
                  own + 3 * node);
  }
} // namespace Supple
