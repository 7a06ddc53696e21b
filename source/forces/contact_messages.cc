// What is told of contact where a step is hard to find, or can't be found.

#include <supple/base/error.h>
#include <supple/base/text.h>
#include <supple/forces/contact.h>
#include <supple/mechanics/selection.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace Supple
{
  namespace
  {
    /** The boundary that most of a part's nodes are on, with its name if it has one. */
    std::string
    boundary_in_words(const Mesh &mesh, const SurfacePart &part)
    {
      unsigned int id = 0, most = 0;
      for (const LocalFace &face : mesh.parts->faces)
        {
          const auto n = std::count_if(face.nodes.begin(), face.nodes.end(), [&](const auto node) {
            return part.has_node(node);
          });
          if (n > most)
            {
              most = n;
              id   = face.boundary_id;
            }
        }
      std::string words = "boundary " + std::to_string(id);
      for (const auto &[name, of_name] : mesh.boundary_names)
        if (of_name == id)
          words += " (" + name + ")";
      return words;
    }


    bool
    holds(const Constraints &constraints, const SurfacePart &part)
    {
      return std::all_of(part.nodes.begin(), part.nodes.begin() + part.n, [&](const auto node) {
        return constraints.holds_node(node);
      });
    }
  } // namespace


  std::string
  Contact::in_words(const SurfacePart &part) const
  {
    const Mesh &mesh         = body.mesh;
    const unsigned int piece = mesh.report.parts[mesh.parts->parts[part.nodes[0]]].piece;
    const std::string words =
      mesh.report.pieces.size() > 1 ? "piece " + std::to_string(piece + 1) + ", " : "";
    return words + boundary_in_words(mesh, part) + ", " +
           Selection(body).vertex_in_words(body.serial_vertex[part.nodes[0]]);
  }


  void
  Contact::require_room_between(const Configuration &configuration,
                                const Constraints &constraints) const
  {
    constexpr double nothing = 1e-6; // of the reach: five iterations and no end

    const std::optional<ContactPair> pair = nearest_own_pair(configuration);
    if (!pair || pair->gap > nothing * pair->reach || !holds(constraints, *pair->part) ||
        !holds(constraints, *pair->other))
      return;
    throw ComputationError(
      "the body would reach itself or another piece where both are held or "
      "moved as prescribed, which can't be: " +
      in_words(*pair->part) + ", and " + in_words(*pair->other));
  }


  std::string
  Contact::nearest_in_words(const Configuration &configuration) const
  {
    std::string words;
    double least                          = std::numeric_limits<double>::max();
    const std::vector<ToolReport> reports = this->reports(configuration);
    for (unsigned int t = 0; t < reports.size(); ++t)
      if (reports[t].gap < least)
        {
          words = "to the tool " + tools[t].parameters.name;
          least = reports[t].gap;
        }
    if (const std::optional<ContactPair> own = nearest_own_pair(configuration);
        own && own->gap < least)
      {
        words = "between " + in_words(*own->part) + ", and " + in_words(*own->other);
        least = own->gap;
      }
    return words.empty() ? "" : "the least gap, " + digits(least, 2) + " m, is that " + words;
  }


  void
  Contact::note_found(const Configuration &configuration, const unsigned int n_corrections)
  {
    if (!friction.any())
      return;
    const GhostValues u(configuration.displacement());
    const Passage &passage = configuration.passage;
    double fastest         = of_friction.fastest_slip;
    for (const Friction::Slip &slip : slips(u.data(), passage))
      fastest = std::max(fastest, slip.way.norm() / (passage.to - passage.from));
    of_friction.fastest_slip     = dealii::Utilities::MPI::max(fastest, body.mesh.communicator);
    of_friction.most_corrections = std::max(of_friction.most_corrections, n_corrections);
  }


  void
  Contact::note_failed()
  {
    of_friction.n_failed += friction.any();
  }
} // namespace Supple
