#include <supple/output/vtk_array.h>

#include <supple/base/compression.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace Supple
{
  namespace
  {
    constexpr std::size_t block_size   = 1 << 18;
    constexpr std::size_t most_at_once = 65535; // in a stored block of the deflate format


    /** The two digits of each number of 12 bits. */
    std::array<std::array<char, 2>, 4096>
    pairs_of_digits()
    {
      const char *const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      std::array<std::array<char, 2>, 4096> pairs;
      for (unsigned int n = 0; n < pairs.size(); ++n)
        pairs[n] = {{digits[n >> 6], digits[n & 63]}};
      return pairs;
    }


    void
    append_base64(std::string &text, const std::string &bytes)
    {
      static const auto pairs = pairs_of_digits();
      const std::size_t begin = text.size(), n_whole = bytes.size() / 3;
      text.resize(begin + (bytes.size() + 2) / 3 * 4);
      char *to         = &text[begin];
      const auto *from = reinterpret_cast<const unsigned char *>(bytes.data());
      for (std::size_t i = 0; i < n_whole; ++i, from += 3, to += 4)
        {
          const unsigned int n = from[0] << 16 | from[1] << 8 | from[2];
          std::memcpy(to, pairs[n >> 12].data(), 2);
          std::memcpy(to + 2, pairs[n & 4095].data(), 2);
        }
      const std::size_t n_left = bytes.size() - 3 * n_whole;
      if (n_left == 0)
        return;
      const unsigned int n = from[0] << 16 | (n_left == 2 ? from[1] << 8 : 0);
      std::memcpy(to, pairs[n >> 12].data(), 2);
      std::memcpy(to + 2, pairs[n & 4095].data(), 2);
      std::fill(text.end() - (3 - n_left), text.end(), '=');
    }


    /** RFC 1950 and 1951: a header, parts with their lengths, and the checksum of all. */
    void
    append_stored(std::string &packed, const unsigned char *const bytes, const std::size_t n_bytes)
    {
      packed += "\x78\x01";
      std::size_t begin = 0;
      do
        {
          const std::size_t n     = std::min(most_at_once, n_bytes - begin);
          const bool last         = begin + n == n_bytes;
          const unsigned char low = n & 255, high = n >> 8;
          const unsigned char head[] = {last, low, high, (unsigned char)~low, (unsigned char)~high};
          packed.append(reinterpret_cast<const char *>(head), sizeof(head));
          packed.append(reinterpret_cast<const char *>(bytes + begin), n);
          begin += n;
        }
      while (begin < n_bytes);
      const std::uint32_t sum = adler32(adler32(0, nullptr, 0), bytes, n_bytes);
      for (const int shift : {24, 16, 8, 0})
        packed += char(sum >> shift);
    }
  } // namespace


  std::string
  vtk_array(const void *const data, const std::size_t n_bytes, const Packing packing)
  {
    const auto *const bytes    = static_cast<const unsigned char *>(data);
    const std::size_t n_blocks = (n_bytes + block_size - 1) / block_size;

    std::vector<std::uint64_t> header = {n_blocks, block_size, n_bytes % block_size};
    std::string packed;
    packed.reserve(n_bytes + n_bytes / 8192 + 64);
    for (std::size_t block = 0; block < n_blocks; ++block)
      {
        const std::size_t begin = block * block_size, before = packed.size();
        const std::size_t n = std::min(block_size, n_bytes - begin);
        if (packing == Packing::stored)
          append_stored(packed, bytes + begin, n);
        else
          packed += compressed(bytes + begin, n);
        header.push_back(packed.size() - before);
      }

    std::string text;
    text.reserve((packed.size() + header.size() * sizeof(header[0])) / 3 * 4 + 16);
    append_base64(text,
                  std::string(reinterpret_cast<const char *>(header.data()),
                              header.size() * sizeof(header[0])));
    append_base64(text, packed);
    return text;
  }
} // namespace Supple
