#include <supple/base/compression.h>

#include <supple/base/error.h>

#include <zlib.h>

namespace Supple
{
  std::string
  compressed(const void *const bytes, const std::size_t n_bytes)
  {
    uLongf size = compressBound(n_bytes);
    std::string packed(size, '\0');
    auto *const to = reinterpret_cast<Bytef *>(&packed[0]);
    if (compress2(to, &size, static_cast<const Bytef *>(bytes), n_bytes, Z_BEST_SPEED) != Z_OK)
      throw WriteError("zlib can't compress " + std::to_string(n_bytes) + " bytes.");
    packed.resize(size);
    return packed;
  }
} // namespace Supple
