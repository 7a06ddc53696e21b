#include <supple/mechanics/selection.h>
#include <supple/observe/probes.h>
#include <supple/run/chosen_vertices.h>

#include <deal.II/base/mpi.h>

namespace Supple
{
  using namespace dealii;

  void
  change_selections(Parameters &scene,
                    const std::function<void(std::string &, const std::string &)> &change)
  {
    for (unsigned int m = 0; m < scene.motions.size(); ++m)
      change(scene.motions[m].of, scene.origin(motion_section(m) + "/Of"));
    change(scene.loads.nodal_force_on, scene.origin("Loads/Nodal force on"));
  }


  Parameters
  with_chosen_vertices(const Parameters &scene, const Body &body)
  {
    Parameters result = scene;
    const Selection selection(body);
    change_selections(result, [&](std::string &text, const std::string &origin) {
      if (after_word(text, point_word).empty())
        return;
      const std::vector<bool> nodes = selection.selected_nodes(text, origin);
      unsigned int vertex           = numbers::invalid_unsigned_int;
      for (unsigned int node = 0; node < body.n_owned; ++node)
        if (nodes[node])
          vertex = body.serial_vertex[node];
      text = vertex_word + std::to_string(Utilities::MPI::min(vertex, body.mesh.communicator));
    });
    result.probes.chosen =
      Probes(body, scene.probes, scene.motions, scene.file).vertices_of_points();
    return result;
  }
} // namespace Supple
