#ifndef supple_compression_h
#define supple_compression_h

#include <cstddef>
#include <string>

namespace Supple
{
  /** A zlib stream of these bytes, at zlib's greatest speed. @throws WriteError */
  std::string
  compressed(const void *bytes, std::size_t n_bytes);
} // namespace Supple

#endif
