#include <supple/mesh/mesh.h>

#include <supple/base/first_process.h>
#include <supple/mesh/edge_middles.h>
#include <supple/mesh/partition.h>
#include <supple/mesh/patches.h>
#include <supple/mesh/whole_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/crc.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>

#include <algorithm>
#include <utility>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    double
    volume_of(const SerialMesh &mesh, const std::size_t cell, const Section &section)
    {
      if (!mesh.middles.empty())
        return quadratic_volume(mesh, cell);
      if (!section.plane())
        return mesh.volume(cell);
      double centroid = 0.;
      for (const unsigned int v : mesh.cell_vertices(cell))
        centroid += mesh.vertices[v][0] / 3.;
      return mesh.volume(cell) * section.thickness_at(centroid);
    }


    /** The same on all machines that read or generate the same mesh. */
    unsigned int
    checksum_of(const SerialMesh &mesh)
    {
      boost::crc_32_type sum;
      const auto add = [&](const auto &values) {
        sum.process_bytes(values.data(), values.size() * sizeof(values[0]));
      };
      add(mesh.vertices);
      add(mesh.cells);
      add(mesh.materials);
      for (const auto &middle : mesh.middles)
        sum.process_bytes(&middle.place, sizeof(middle.place));
      for (const auto &face : mesh.boundary)
        {
          add(face.vertices);
          sum.process_bytes(&face.boundary_id, sizeof(face.boundary_id));
        }
      return sum.checksum();
    }
  } // namespace


  Mesh::Mesh(const MeshParameters &parameters,
             const PlaneParameters &plane,
             const bool with_patches,
             const ParameterFile &scene,
             const MPI_Comm communicator)
    : communicator(communicator)
  {
    SerialMesh whole;
    std::vector<unsigned int> owner;
    on_first_process(communicator, [&] {
      whole = make_whole(parameters, plane, with_patches, scene);
      owner = partition(whole, Utilities::MPI::n_mpi_processes(communicator));
    });
    share();
    parts = std::make_unique<DistributedMesh>(
      distribute(std::move(whole), std::move(owner), communicator), communicator);
    if (parts->dimension == 2)
      section = plane.section;
  }


  SerialMesh
  Mesh::make_whole(const MeshParameters &parameters,
                   const PlaneParameters &plane,
                   const bool with_patches,
                   const ParameterFile &scene)
  {
    WholeMesh whole  = whole_mesh(parameters, plane, scene);
    SerialMesh &mesh = whole.mesh;
    report           = std::move(whole.report);
    if (mesh.dimension == 2)
      section = plane.section;
    measure(mesh);
    if (with_patches)
      mesh.patches = make_patches(mesh);
    return std::move(mesh);
  }


  void
  Mesh::measure(const SerialMesh &mesh)
  {
    n_cells      = mesh.cells.size();
    n_vertices   = mesh.vertices.size() - report.unused_vertices;
    n_middles    = mesh.middles.size();
    bounding_box = box_around(mesh, mesh.vertices);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        volume += volume_of(mesh, c, section);
        ++materials[mesh.materials[c]];
      }
    for (const auto &face : mesh.boundary)
      ++boundaries[face.boundary_id];
    boundary_names = mesh.boundary_names;
    material_names = mesh.material_names;
    checksum       = checksum_of(mesh);
  }


  void
  Mesh::share()
  {
    const auto share = [&](auto &value) { value = Utilities::MPI::broadcast(communicator, value); };
    share(n_cells);
    share(n_vertices);
    share(n_middles);
    share(volume);
    share(bounding_box);
    share(boundaries);
    share(materials);
    share(boundary_names);
    share(material_names);
    share(checksum);
    share(report);
  }


  double
  Mesh::diameter() const
  {
    const auto &corners = bounding_box.get_boundary_points();
    return corners.first.distance(corners.second);
  }


  std::string
  Mesh::extent() const
  {
    return extent_in_words(bounding_box, section.plane() ? 2 : 3);
  }


  std::string
  Mesh::cell_name() const
  {
    return section.plane() ? "triangles" : is_quadratic() ? "quadratic tetrahedra" : "tetrahedra";
  }
} // namespace Supple
