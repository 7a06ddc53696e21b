#ifndef supple_msh_elements_h
#define supple_msh_elements_h

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /**
   * What the text of a .msh file says of its elements. Versions 1 and 2 give each element its
   * group, but Gmsh's library keeps groups by elementary number alone: it takes all elements of one
   * elementary number to be in the groups of each of them.
   */
  struct MshElements
  {
    std::size_t n_announced = 0; ///< 0 if the file doesn't say

    /** Sorted nodes of an edge, a triangle or a tetrahedron, the rest 0, and its group, 0 for none;
     * ascending, of versions 1 and 2. */
    std::vector<std::pair<std::array<std::size_t, 4>, unsigned int>> groups;

    /** Whether the file gives the group of an element with these nodes.
     * @param ids set to all that it gives, without 0, ascending */
    bool
    find(std::array<std::size_t, 4> nodes, std::vector<unsigned int> &ids) const;
  };


  /** Reads them, ASCII or binary; while Gmsh's library is initialized. */
  MshElements
  read_msh_elements(const std::string &file);
} // namespace Supple

#endif
