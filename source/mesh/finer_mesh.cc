#include <supple/mesh/finer_mesh.h>

namespace Supple
{
  namespace
  {
    using Shape   = MeshParameters::Shape;
    using Entries = std::vector<std::pair<std::string, std::string>>;


    bool
    is_power_of_two(const unsigned int n)
    {
      return n > 0 && (n & (n - 1)) == 0;
    }


    /** The numbers, each times a factor, set apart by commas. */
    template <class Numbers>
    std::string
    multiplied(const Numbers &numbers, const unsigned int factor)
    {
      std::string text;
      for (const unsigned int number : numbers)
        text += (text.empty() ? "" : ", ") + std::to_string(factor * number);
      return text;
    }


    Entries
    entries_of_halved_edges(unsigned int n_parts)
    {
      unsigned int times = 0;
      for (; n_parts > 1; n_parts /= 2)
        ++times;
      return {{"Mesh/Refine region", "1"}, {"Mesh/Refine region times", std::to_string(times)}};
    }
  } // namespace


  bool
  can_be_cut(const MeshParameters &mesh, const unsigned int n_parts)
  {
    if (n_parts == 1)
      return true;
    return !mesh.refinement.asked() && (mesh.shape != Shape::file || is_power_of_two(n_parts));
  }


  Entries
  entries_of_finer(const MeshParameters &mesh, const unsigned int n_parts)
  {
    if (n_parts == 1)
      return {};
    Entries entries;
    switch (mesh.shape)
      {
        case Shape::box:
          entries = {{"Mesh/Box cubes", multiplied(mesh.cubes, n_parts)}};
          break;
        case Shape::rectangle:
          entries = {{"Mesh/Rectangle squares", multiplied(mesh.squares, n_parts)}};
          break;
        case Shape::hollow_cylinder:
          return {{"Mesh/Cylinder sectors", std::to_string(n_parts * mesh.sectors)},
                  {"Mesh/Cylinder layers", std::to_string(n_parts * mesh.layers)},
                  {"Mesh/Cylinder rings", std::to_string(n_parts * (mesh.rings - 1) + 1)}};
        default:
          return entries_of_halved_edges(n_parts);
      }
    if (!mesh.layer_rows.empty())
      entries.emplace_back("Mesh/Layer rows", multiplied(mesh.layer_rows, n_parts));
    return entries;
  }
} // namespace Supple
