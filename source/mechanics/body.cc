#include <supple/mechanics/body.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>

#include <deal.II/base/multithread_info.h>
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
    // Of one thread, at the least.
    constexpr std::size_t least_cells = 8000;


    unsigned int
    threads_for(const std::size_t n_cells, const unsigned int most)
    {
      const std::size_t sensible = std::max<std::size_t>(1, n_cells / least_cells);
      return std::min<std::size_t>(most, sensible);
    }
  } // namespace


  Body::Body(const Mesh &mesh,
             const MaterialParameters &material,
             const CorotationParameters &corotation,
             const unsigned int most_threads,
             const ParameterFile &scene)
    : mesh(mesh)
    , rotation(corotation.rotation)
    , partitioner(mesh.parts->partitioner)
    , n_threads(threads_for(mesh.parts->cells.size(), most_threads))
    , n_owned(mesh.parts->n_owned)
    , n_local(mesh.parts->n_local)
    , positions(mesh.parts->positions)
    , serial_vertex(mesh.parts->serial_vertex)
  {
    MultithreadInfo::set_thread_limit(n_threads); // deal.II's vectors have as many
    collect_cells(material, scene);
  }


  unsigned int
  Body::n_dofs() const
  {
    return mesh.section.plane() ? partitioner->size() / 3 * 2 : partitioner->size();
  }


  bool
  Body::is_held_by_nature(const unsigned int dof) const
  {
    return (mesh.section.plane() && dof % 3 == 2) ||
           (mesh.section.axisymmetric() && dof % 3 == 0 && positions[dof / 3][0] == 0.);
  }


  void
  Body::collect_cells(const MaterialParameters &parameters, const ParameterFile &scene)
  {
    const auto exceptions = parameters.exceptions(scene.origin("Material/By id"));
    for (const auto &[id, n_cells] : mesh.materials)
      {
        const auto exception = exceptions.find(id);
        materials[id] = exception == exceptions.end() ? parameters.preset() : exception->second;
      }
    for (const auto &[id, other_material] : exceptions)
      if (mesh.materials.find(id) == mesh.materials.end())
        throw InputError(scene.origin("Material/By id") + ": no cell has the material id " +
                         std::to_string(id) + ".");

    const bool cured = parameters.cure == MaterialParameters::LockingCure::patches;
    std::vector<Cell> known_cells;
    std::vector<PatchCell> patch_cells;
    for (const LocalCell &cell : mesh.parts->cells)
      {
        const bool touches_owned =
          std::any_of(cell.nodes.begin(), cell.nodes.end(), [&](const unsigned int node) {
            return node < n_owned;
          });
        if (!touches_owned && !cell.owned)
          continue;
        IsotropicMaterial cell_is_of = material(cell.material_id);
        if (parameters.vertex_mass > 0.)
          cell_is_of.density = 0.;
        if (cured)
          {
            const auto end = cell.nodes.begin() + (mesh.section.plane() ? 3 : 4);
            patch_cells.push_back({{cell.nodes.begin(), end}, cell.patch, cell_is_of.bulk()});
            cell_is_of = cell_is_of.deviatoric();
          }
        known_cells.push_back({cell.nodes, cell_is_of, cell.owned});
        cell_nodes.push_back(cell.nodes);
        cell_index.push_back(cell.index);
        cell_material.push_back(cell.material_id);
      }
    cells = std::make_unique<Cells>(positions,
                                    n_owned,
                                    known_cells,
                                    parameters.lumped,
                                    parameters.vertex_mass,
                                    mesh.section,
                                    n_threads);
    if (cured)
      patches = std::make_unique<VolumetricPatches>(*cells,
                                                    patch_cells,
                                                    n_owned,
                                                    rotation == RotationMethod::none
                                                      ? VolumeMeasure::trace
                                                      : parameters.volume_measure,
                                                    mesh.parts->patch_partitioner);
  }


  void
  Body::initialize(Vector &vector) const
  {
    vector.reinit(partitioner);
  }


  void
  Body::update_rotations(const Vector &displacement, Effort &effort) const
  {
    if (rotation == RotationMethod::none)
      return;
    const PhaseTimer timer(effort, Phase::rotations);
    const GhostValues values(displacement);
    cells->update_rotations(rotation, values.data());
    if (patches)
      patches->update(values.data());
    effort.rotations_computed += cell_nodes.size();
  }


  void
  Body::update_rotation_stiffness(const Tangent tangent,
                                  const Vector &displacement,
                                  Effort &effort) const
  {
    const PhaseTimer timer(effort, Phase::assembly);
    const GhostValues values(displacement);
    if (patches)
      cells->update_rotation_stiffness(tangent,
                                       values.data(),
                                       patches->measure,
                                       patches->mean_stress(values.data()));
    else
      cells->update_rotation_stiffness(tangent, values.data());
  }


  void
  Body::add_stiffness_product(const double *w, double *y) const
  {
    cells->add_stiffness_product(w, y);
    if (patches)
      patches->add_product(1., w, y);
  }


  CellSums
  Body::sums(const double *displacement, const double *velocity) const
  {
    CellSums sums = cells->sums(displacement, velocity);
    if (patches)
      sums.elastic += patches->energy(displacement);
    return sums;
  }


  std::vector<CellState>
  Body::states(const double *displacement) const
  {
    std::vector<CellState> states = cells->states(displacement);
    if (patches)
      {
        const std::vector<double> mean_stress = patches->mean_stress(displacement);
        for (std::size_t c = 0; c < states.size(); ++c)
          states[c].pressure = -mean_stress[c];
      }
    return states;
  }


  double
  Body::round_off_square() const
  {
    return cells->round_off_square() + (patches ? patches->round_off_square() : 0.);
  }


  void
  Body::internal_force(Vector &force, const Vector &displacement, Effort &effort) const
  {
    const PhaseTimer timer(effort, Phase::forces);
    const GhostValues values(displacement);
    sum_into(force, [&](double *sum) {
      cells->add_internal_force(values.data(), sum);
      if (patches)
        patches->add_internal_force(values.data(), sum);
    });
  }


  const IsotropicMaterial &
  Body::material(const unsigned int id) const
  {
    return materials.at(id);
  }


  double
  Body::largest_poisson() const
  {
    double poisson = -1.;
    for (const auto &[id, n_cells] : mesh.materials)
      poisson = std::max(poisson, material(id).poisson());
    return poisson;
  }


  Point<3>
  Body::position(const unsigned int node) const
  {
    return {positions[node][0], positions[node][1], positions[node][2]};
  }


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


  std::vector<bool>
  Body::selected_nodes(const std::string &text, const std::string &origin) const
  {
    const auto argument = [&](const std::string &keyword) {
      return text.rfind(keyword + " ", 0) == 0 ? text.substr(keyword.size() + 1) : "";
    };
    std::vector<bool> nodes(n_local, text == "all");
    if (text == "all")
      return nodes;

    if (!argument("region").empty())
      return region_nodes(argument("region"), origin);

    if (!argument("boundary").empty())
      {
        const auto ids = numbers_in(argument("boundary"));
        for (const double id : ids)
          {
            const auto more = boundary_nodes(static_cast<unsigned int>(id), origin);
            std::transform(
              nodes.begin(), nodes.end(), more.begin(), nodes.begin(), std::logical_or<>());
          }
        if (!ids.empty())
          return nodes;
      }

    auto index       = numbers_in(argument("vertex"));
    const auto point = numbers_in(argument("nearest to"));
    if (point.size() == 3)
      index = {double(vertex_of_body({point[0], point[1], point[2]}, origin))};
    if (index.size() != 1)
      throw InputError(
        origin +
        ": it must be all, or one of these words with what follows: vertex INDEX, nearest to "
        "X, Y, Z, boundary IDS, region EXPRESSION.");
    unsigned int n_found = 0;
    for (unsigned int node = 0; node < n_local; ++node)
      {
        nodes[node] = serial_vertex[node] == index[0];
        n_found += nodes[node];
      }
    if (Utilities::MPI::max(n_found, mesh.communicator) == 0)
      throw InputError(origin + ": the body has no such vertex; the indices go from 0 to " +
                       std::to_string(mesh.n_vertices + mesh.report.unused_vertices - 1) + ".");
    return nodes;
  }


  unsigned int
  Body::vertex_of_body(const Point<3> &point, const std::string &origin) const
  {
    const auto [vertex, distance] = nearest_vertex(point);
    const auto corners            = mesh.bounding_box.get_boundary_points();
    for (unsigned int d = 0; d < 3; ++d)
      if (std::max(corners.first[d] - point[d], point[d] - corners.second[d]) >
          0.02 * mesh.diameter())
        {
          std::ostringstream text;
          text << origin << ": this point is outside the body, which lies in " << mesh.extent()
               << " m; its nearest vertex is " << distance << " m away.";
          throw InputError(text.str());
        }
    return vertex;
  }


  Point<3>
  Body::place_of_vertex(const unsigned int vertex) const
  {
    Tensor<1, 3> place;
    for (unsigned int node = 0; node < n_owned; ++node)
      if (serial_vertex[node] == vertex)
        place = position(node);
    return Point<3>(Utilities::MPI::sum(place, mesh.communicator));
  }


  std::string
  Body::vertex_in_words(const unsigned int vertex) const
  {
    const Point<3> place = place_of_vertex(vertex);
    std::ostringstream text;
    text << "vertex " << vertex << " at (" << place[0] << ", " << place[1] << ", " << place[2]
         << ")";
    return text.str();
  }


  std::pair<unsigned int, double>
  Body::nearest_vertex(const Point<3> &point) const
  {
    // Of several that are equally near, the one with the smallest index.
    double smallest      = std::numeric_limits<double>::max();
    unsigned int nearest = numbers::invalid_unsigned_int;
    for (unsigned int node = 0; node < n_owned; ++node)
      {
        const double distance = position(node).distance(point);
        if (distance < smallest || (distance == smallest && serial_vertex[node] < nearest))
          {
            smallest = distance;
            nearest  = serial_vertex[node];
          }
      }
    const double distance = Utilities::MPI::min(smallest, mesh.communicator);
    return {Utilities::MPI::min(smallest == distance ? nearest : numbers::invalid_unsigned_int,
                                mesh.communicator),
            distance};
  }


  void
  Body::require_boundary(const unsigned int boundary_id, const std::string &origin) const
  {
    if (mesh.boundaries.find(boundary_id) == mesh.boundaries.end())
      {
        std::string known;
        for (const auto &[id, n_faces] : mesh.boundaries)
          known += (known.empty() ? "" : ", ") + std::to_string(id) + " (" +
                   std::to_string(n_faces) + " faces)";
        throw InputError(origin + ": the body has no boundary " + std::to_string(boundary_id) +
                         ". It has: " + known + ".");
      }
  }


  std::vector<std::array<unsigned int, 3>>
  Body::boundary_faces(const std::vector<unsigned int> &boundary_ids,
                       const std::string &origin) const
  {
    for (const unsigned int id : boundary_ids)
      require_boundary(id, origin);

    std::vector<std::array<unsigned int, 3>> faces;
    for (const LocalFace &face : mesh.parts->faces)
      if (std::count(boundary_ids.begin(), boundary_ids.end(), face.boundary_id) > 0)
        faces.push_back(face.nodes);
    return faces;
  }


  std::vector<bool>
  Body::boundary_nodes(const unsigned int boundary_id, const std::string &origin) const
  {
    require_boundary(boundary_id, origin);

    // A face is seen by the process that owns its cell; its nodes may be owned by another one.
    Vector marked;
    initialize(marked);
    for (const LocalFace &face : mesh.parts->faces)
      if (face.owned && face.boundary_id == boundary_id)
        for (const unsigned int node : face.nodes)
          marked.local_element(3 * node) = 1.;
    marked.compress(VectorOperation::add);

    const GhostValues values(marked);
    std::vector<bool> nodes(n_local);
    for (unsigned int node = 0; node < n_local; ++node)
      nodes[node] = values.data()[3 * node] > 0.;
    return nodes;
  }


  std::vector<bool>
  Body::region_nodes(const std::string &expression, const std::string &origin) const
  {
    const Expression inside(expression, 1, origin);
    if (inside.depends_on_time())
      throw InputError(origin + ": a region is made of x, y and z; it can't depend on the time t.");
    std::vector<bool> nodes(n_local);
    unsigned int n_found = 0;
    bool is_finite       = true;
    for (unsigned int node = 0; node < n_local; ++node)
      {
        const double value = inside.value(position(node), 0.);
        is_finite          = is_finite && std::isfinite(value);
        nodes[node]        = value != 0.;
        n_found += nodes[node];
      }
    if (Utilities::MPI::max(is_finite ? 0 : 1, mesh.communicator) > 0)
      throw InputError(origin + ": it is not a finite number at every vertex.");
    if (Utilities::MPI::max(n_found, mesh.communicator) == 0)
      {
        std::string known;
        for (const auto &[id, n_faces] : mesh.boundaries)
          known += (known.empty() ? "" : ", ") + std::to_string(id);
        throw InputError(origin + ": this region has no vertex of the body, which lies in " +
                         mesh.extent() + " m and has the boundaries " + known + ".");
      }
    return nodes;
  }
} // namespace Supple
