// A mesh written by Gmsh in each format it knows comes back with its cells, materials and
// boundaries. What ends the process that reads it does not end this one.

#include <supple/base/error.h>
#include <supple/mesh/mesh_check.h>
#include <supple/mesh/mesh_generators.h>
#include <supple/mesh/mesh_reader.h>
#include <supple/mesh/separate_process.h>

#include <cstdio>
#include <cstdlib>
#include <gmsh.h>
#include <map>

using namespace Supple;

namespace
{
  /** Two cubes side by side with the materials 1 and 2; boundaries 5 (x = 0) and 6 (x = 2). */
  void
  make_model()
  {
    MeshParameters parameters;
    parameters.size   = {2., 1., 1.};
    parameters.cubes  = {{2, 1, 1}};
    const auto mesh   = box_mesh(parameters);
    const auto volume = [](const unsigned int material) { return static_cast<int>(material); };

    gmsh::model::add("two cubes");
    for (const int material : {1, 2})
      {
        gmsh::model::addDiscreteEntity(3, volume(material));
        gmsh::model::addPhysicalGroup(3, {volume(material)}, material);
      }
    std::vector<std::size_t> node_tags;
    std::vector<double> coordinates;
    for (const auto &vertex : mesh.vertices)
      {
        node_tags.push_back(node_tags.size() + 1);
        for (unsigned int d = 0; d < 3; ++d)
          coordinates.push_back(vertex[d]);
      }
    gmsh::model::mesh::addNodes(3, 1, node_tags, coordinates);

    std::size_t next_tag = 1;
    std::map<int, std::vector<std::size_t>> tags[2], nodes[2];
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const int material = c < 6 ? 1 : 2;
        tags[0][material].push_back(next_tag++);
        for (const unsigned int v : mesh.cells[c])
          nodes[0][material].push_back(v + 1);
      }
    for (const auto &triangle : mesh.boundary)
      if (triangle.boundary_id < 2)
        {
          const int id = triangle.boundary_id + 5;
          tags[1][id].push_back(next_tag++);
          for (const unsigned int v : triangle.vertices)
            nodes[1][id].push_back(v + 1);
        }
    for (const auto &[material, list] : tags[0])
      gmsh::model::mesh::addElementsByType(volume(material), 4, list, nodes[0][material]);
    for (const auto &[id, list] : tags[1])
      {
        gmsh::model::addDiscreteEntity(2, id);
        gmsh::model::addPhysicalGroup(2, {id}, id);
        gmsh::model::mesh::addElementsByType(id, 2, list, nodes[1][id]);
      }
  }


  void
  write_and_read(const std::string &name, const double version, const bool binary)
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    make_model();
    if (version > 0.)
      gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::option::setNumber("Mesh.Binary", binary);
    gmsh::write(name);
    gmsh::finalize();

    SerialMesh mesh         = read_mesh(name, "test");
    const MeshReport report = check_mesh(mesh, "test");
    std::map<unsigned int, unsigned int> materials, boundaries;
    double volume = 0.;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        ++materials[mesh.materials[c]];
        volume += mesh.volume(c);
      }
    for (const auto &triangle : mesh.boundary)
      ++boundaries[triangle.boundary_id];
    std::printf("%s, version %.1f, %s: %zu vertices, %zu cells, volume %.9f, warnings %zu",
                name.c_str(),
                version,
                binary ? "binary" : "ASCII",
                mesh.vertices.size(),
                mesh.cells.size(),
                volume,
                report.warnings.size());
    for (const auto &[id, n] : materials)
      std::printf(", material %u: %u", id, n);
    for (const auto &[id, n] : boundaries)
      std::printf(", boundary %u: %u", id, n);
    std::printf("\n");
  }


  void
  answer_of(const std::string &what,
            const std::function<std::string()> &function,
            const bool say_why = true)
  {
    const ProcessLimits limits{1, 200000000};
    std::printf("%s: ", what.c_str());
    try
      {
        std::printf("%zu bytes\n", in_separate_process(function, limits).size());
      }
    catch (const InputError &error)
      {
        std::printf("the input: %s\n", error.what());
      }
    catch (const SeparateProcessError &error)
      {
        std::printf("%s\n", say_why ? error.what() : "no answer");
      }
  }


  void
  end_badly()
  {
    answer_of("a megabyte", [] { return std::string(1000000, '\0'); });
    answer_of("an error of ours", []() -> std::string { throw InputError("wrong"); });
    answer_of("another error", []() -> std::string { throw std::out_of_range("map::at"); });
    answer_of("a crash", []() -> std::string { std::abort(); });
    answer_of("an early end", []() -> std::string { std::_Exit(0); });
    answer_of("no end", []() -> std::string {
      for (volatile bool forever = true; forever;)
        ;
      return "";
    });
    // A sanitizer ends the process in its own way.
    answer_of(
      "too much memory", [] { return std::string(500000000, ' '); }, false);
  }
} // namespace


int
main()
{
  write_and_read("one.msh", 1., false);
  write_and_read("two.msh", 2.2, false);
  write_and_read("two-binary.msh", 2.2, true);
  write_and_read("four.msh", 4.1, false);
  write_and_read("four-binary.msh", 4.1, true);
  write_and_read("legacy.vtk", 0., false);
  write_and_read("ideas.unv", 0., false);
  write_and_read("medit.mesh", 0., false);
  write_and_read("nastran.bdf", 0., false);
  end_badly();
}
