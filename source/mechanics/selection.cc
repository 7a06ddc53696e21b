#include <supple/mechanics/selection.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/input/entries.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** The numbers of "1, 2, 3"; nothing if the text is something else. */
    std::vector<double>
    numbers_in(const std::string &text)
    {
      try
        {
          const auto numbers = Utilities::string_to_double(Utilities::split_string_list(text, ','));
          for (const double number : numbers)
            if (!std::isfinite(number))
              return {};
          return numbers;
        }
      catch (const ExceptionBase &)
        {
          return {};
        }
    }
  } // namespace


  std::string
  after_word(const std::string &text, const std::string &word)
  {
    return text.rfind(word, 0) == 0 ? text.substr(word.size()) : "";
  }


  std::vector<bool>
  Selection::selected_nodes(const std::string &text, const std::string &origin) const
  {
    std::vector<bool> nodes(body.n_local, text == "all");
    if (text == "all")
      return nodes;

    if (!after_word(text, "region ").empty())
      return region_nodes(after_word(text, "region "), origin);

    if (!after_word(text, "boundary ").empty())
      {
        for (const std::string &boundary :
             Utilities::split_string_list(after_word(text, "boundary "), ','))
          {
            const auto more = boundary_nodes(boundary, origin);
            std::transform(
              nodes.begin(), nodes.end(), more.begin(), nodes.begin(), std::logical_or<>());
          }
        return nodes;
      }

    auto index       = numbers_in(after_word(text, vertex_word));
    const auto point = numbers_in(after_word(text, point_word));
    if (point.size() == 3)
      index = {double(vertex_of_body({point[0], point[1], point[2]}, origin))};
    if (index.size() != 1)
      throw InputError(
        origin +
        ": it must be all, or one of these words with what follows: vertex INDEX, nearest to "
        "X, Y, Z, boundary IDS, region EXPRESSION.");
    unsigned int n_found = 0;
    for (unsigned int node = 0; node < body.n_local; ++node)
      {
        nodes[node] = body.serial_vertex[node] == index[0];
        n_found += nodes[node];
      }
    if (Utilities::MPI::max(n_found, body.mesh.communicator) == 0)
      throw InputError(origin + ": the body has no such vertex; the indices go from 0 to " +
                       std::to_string(body.mesh.n_serial_vertices() - 1) + ".");
    return nodes;
  }


  unsigned int
  Selection::vertex_of_body(const Point<3> &point, const std::string &origin) const
  {
    const auto [vertex, distance] = nearest_vertex(point);
    const auto corners            = body.mesh.bounding_box.get_boundary_points();
    for (unsigned int d = 0; d < 3; ++d)
      if (std::max(corners.first[d] - point[d], point[d] - corners.second[d]) >
          0.02 * body.mesh.diameter())
        {
          std::ostringstream text;
          text << origin << ": this point is outside the body, which lies in " << body.mesh.extent()
               << " m; its nearest vertex is " << distance << " m away.";
          throw InputError(text.str());
        }
    return vertex;
  }


  Point<3>
  Selection::place_of_vertex(const unsigned int vertex) const
  {
    Tensor<1, 3> place;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      if (body.serial_vertex[node] == vertex)
        place = body.position(node);
    return Point<3>(Utilities::MPI::sum(place, body.mesh.communicator));
  }


  std::string
  Selection::vertex_in_words(const unsigned int vertex) const
  {
    const Point<3> place = place_of_vertex(vertex);
    std::ostringstream text;
    text << "vertex " << vertex << " at (" << place[0] << ", " << place[1] << ", " << place[2]
         << ")";
    return text.str();
  }


  std::pair<unsigned int, double>
  Selection::nearest_vertex(const Point<3> &point) const
  {
    // Of several that are equally near, the one with the smallest index.
    double smallest      = std::numeric_limits<double>::max();
    unsigned int nearest = numbers::invalid_unsigned_int;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      {
        const double distance = body.position(node).distance(point);
        if (distance < smallest || (distance == smallest && body.serial_vertex[node] < nearest))
          {
            smallest = distance;
            nearest  = body.serial_vertex[node];
          }
      }
    const double distance = Utilities::MPI::min(smallest, body.mesh.communicator);
    return {Utilities::MPI::min(smallest == distance ? nearest : numbers::invalid_unsigned_int,
                                body.mesh.communicator),
            distance};
  }


  unsigned int
  Selection::boundary_id(const std::string &boundary, const std::string &origin) const
  {
    const auto &boundaries = body.mesh.boundaries;
    const auto &names      = body.mesh.boundary_names;
    const bool is_id       = Range::whole_number(0).match(boundary);
    const auto found       = is_id ? names.end() : names.find(boundary);
    if (is_id && boundaries.count(std::stoul(boundary)) > 0)
      return std::stoul(boundary);
    if (found != names.end() && boundaries.count(found->second) > 0)
      return found->second;

    std::string known;
    for (const auto &[id, n_faces] : boundaries)
      known += (known.empty() ? "" : ", ") + std::to_string(id) + " (" + std::to_string(n_faces) +
               (n_faces == 1 ? " face)" : " faces)");
    for (const auto &[name, id] : names)
      if (boundaries.count(id) > 0)
        known += ", " + name + " (boundary " + std::to_string(id) + ")";
    const std::string problem =
      is_id ? "the body has no boundary " + boundary
      : found != names.end()
        ? "no face of the surface has the id " + std::to_string(found->second) + " of the group " +
            boundary +
            ": its faces lie inside the body, are in another group of a lesser id too, or have "
            "another id by Mesh/Boundary regions"
        : "'" + boundary +
            "' is no boundary id, and no single group of the mesh file has this name";
    throw InputError(origin + ": " + problem + ". The body has: " + known + ".");
  }


  Faces
  Selection::boundary_faces(const std::vector<std::string> &boundaries,
                            const std::string &origin) const
  {
    std::vector<unsigned int> boundary_ids;
    for (const std::string &boundary : boundaries)
      boundary_ids.push_back(boundary_id(boundary, origin));

    Faces faces;
    const DistributedMesh &parts = *body.mesh.parts;
    for (std::size_t f = 0; f < parts.faces.size(); ++f)
      if (std::count(boundary_ids.begin(), boundary_ids.end(), parts.faces[f].boundary_id) > 0)
        {
          faces.corners.push_back(parts.faces[f].nodes);
          if (parts.is_quadratic())
            faces.middles.push_back(parts.face_middles[f]);
        }
    return faces;
  }


  std::vector<bool>
  Selection::boundary_nodes(const std::string &boundary, const std::string &origin) const
  {
    const unsigned int id = boundary_id(boundary, origin);

    // A face is seen by the process that owns its cell; its nodes may be owned by another one.
    Vector marked;
    body.initialize(marked);
    const DistributedMesh &parts = *body.mesh.parts;
    for (std::size_t f = 0; f < parts.faces.size(); ++f)
      if (parts.faces[f].owned && parts.faces[f].boundary_id == id)
        {
          for (const unsigned int node : parts.faces[f].nodes)
            marked.local_element(3 * node) = 1.;
          if (parts.is_quadratic())
            for (const unsigned int node : parts.face_middles[f])
              marked.local_element(3 * node) = 1.;
        }
    marked.compress(VectorOperation::add);

    const GhostValues values(marked);
    std::vector<bool> nodes(body.n_local);
    for (unsigned int node = 0; node < body.n_local; ++node)
      nodes[node] = values.data()[3 * node] > 0.;
    return nodes;
  }


  std::vector<bool>
  Selection::region_nodes(const std::string &expression, const std::string &origin) const
  {
    const Expression inside(expression, 1, origin);
    if (inside.depends_on_time())
      throw InputError(origin + ": a region is made of x, y and z; it can't depend on the time t.");
    std::vector<bool> nodes(body.n_local);
    unsigned int n_found = 0;
    bool is_finite       = true;
    for (unsigned int node = 0; node < body.n_local; ++node)
      {
        const double value = inside.value(body.position(node), 0.);
        is_finite          = is_finite && std::isfinite(value);
        nodes[node]        = value != 0.;
        n_found += nodes[node];
      }
    if (Utilities::MPI::max(is_finite ? 0 : 1, body.mesh.communicator) > 0)
      throw InputError(origin + ": it is not a finite number at every vertex.");
    if (Utilities::MPI::max(n_found, body.mesh.communicator) == 0)
      {
        std::string known;
        for (const auto &[id, n_faces] : body.mesh.boundaries)
          known += (known.empty() ? "" : ", ") + std::to_string(id);
        throw InputError(origin + ": this region has no vertex of the body, which lies in " +
                         body.mesh.extent() + " m and has the boundaries " + known + ".");
      }
    return nodes;
  }
} // namespace Supple
