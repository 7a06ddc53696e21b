#include <supple/mesh/finer_mesh.h>
#include <supple/mesh/mesh_counts.h>

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
    if (mesh.shape == Shape::file)
      return entries_of_halved_edges(n_parts);
    Entries entries;
    for (const MeshCounts &counts : counts_of(mesh))
      {
        std::string numbers;
        for (const unsigned int n : counts.intervals)
          numbers += (numbers.empty() ? "" : ", ") + std::to_string(n_parts * n + counts.added);
        if (!numbers.empty())
          entries.emplace_back(counts.entry, numbers);
      }
    return entries;
  }
} // namespace Supple
