#ifndef supple_msh_blocks_h
#define supple_msh_blocks_h

#include <supple/mesh/msh_reader.h>

namespace Supple
{
  /**
   * Looks through the blocks of $Nodes and $Elements of a .msh file of version 4, where Gmsh's
   * library takes the last place of a node that is given twice, and drops what goes beyond what is
   * announced.
   * @return how many elements there are; 0 if the file has kinds of elements that are not known
   * @throws InputError where the file has not what it announces, or a node has two places
   */
  std::size_t
  check_msh_blocks(const std::string &file, const MshFormat &format);
} // namespace Supple

#endif
