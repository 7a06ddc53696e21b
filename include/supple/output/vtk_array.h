#ifndef supple_vtk_array_h
#define supple_vtk_array_h

#include <cstddef>
#include <string>
#include <vector>

namespace Supple
{
  /** How the blocks of an array are packed. Readers see zlib streams either way. */
  enum class Packing
  {
    stored,    ///< as they are: a copy and a checksum
    compressed ///< at zlib's greatest speed
  };


  /**
   * The content of a DataArray of VTK's XML files with format="binary", header_type="UInt64" and
   * compressor="vtkZLibDataCompressor": in base64 first the header, which has the number of blocks,
   * their size of 262144 bytes, that of the last one if it is shorter, and the size of each when it
   * is packed; then the blocks.
   */
  std::string
  vtk_array(const void *bytes, std::size_t n_bytes, Packing packing);


  template <class Value>
  std::string
  vtk_array(const std::vector<Value> &values, const Packing packing)
  {
    return vtk_array(values.data(), values.size() * sizeof(Value), packing);
  }
} // namespace Supple

#endif
