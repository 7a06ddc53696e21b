#include <supple/base/text.h>
#include <supple/mechanics/selection.h>
#include <supple/observe/probes.h>
#include <supple/run/chosen_vertices.h>

#include <deal.II/base/mpi.h>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    std::string
    in_words(const Point<3> &place)
    {
      return digits(place[0], all_digits) + ", " + digits(place[1], all_digits) + ", " +
             digits(place[2], all_digits);
    }
  } // namespace


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
      if (after_word(text, point_word).empty() && after_word(text, vertex_word).empty())
        return;
      const std::vector<bool> nodes = selection.selected_nodes(text, origin);
      unsigned int vertex           = numbers::invalid_unsigned_int;
      for (unsigned int node = 0; node < body.n_owned; ++node)
        if (nodes[node])
          vertex = body.serial_vertex[node];
      vertex = Utilities::MPI::min(vertex, body.mesh.communicator);
      text   = body.is_middle(vertex) ? point_word + in_words(selection.place_of_vertex(vertex))
                                      : vertex_word + std::to_string(vertex);
    });
    result.probes.chosen = Probes(body, scene.probes, scene.motions, scene.file).places_of_points();
    return result;
  }
} // namespace Supple
