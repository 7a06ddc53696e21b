// The arrays of VTU files, unpacked by zlib itself, with sizes at and beside the borders of blocks;
// and pieces of all kinds of cells, empty ones too.

#include <supple/output/vtk_array.h>
#include <supple/output/vtu_piece.h>

#include <zlib.h>

#include <cstdint>
#include <cstdio>
#include <cstring>

using namespace Supple;

namespace
{
  std::string
  from_base64(const std::string &text)
  {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    for (std::size_t i = 0; i + 3 < text.size(); i += 4)
      {
        unsigned long n = 0;
        for (std::size_t k = i; k < i + 4; ++k)
          n = 64 * n + (text[k] == '=' ? 0 : digits.find(text[k]));
        bytes += char(n >> 16);
        if (text[i + 2] != '=')
          bytes += char(n >> 8);
        if (text[i + 3] != '=')
          bytes += char(n);
      }
    return bytes;
  }


  std::uint64_t
  number(const std::string &bytes, const std::size_t k)
  {
    std::uint64_t n;
    std::memcpy(&n, bytes.data() + 8 * k, 8);
    return n;
  }


  std::string
  unpacked(const std::string &text, std::uint64_t &n_blocks)
  {
    n_blocks                 = number(from_base64(text.substr(0, 32)), 0);
    const std::size_t length = (8 * (3 + n_blocks) + 2) / 3 * 4;
    const std::string header = from_base64(text.substr(0, length));
    const std::string packed = from_base64(text.substr(length));
    const std::uint64_t size = number(header, 1), of_last = number(header, 2);
    const auto *from            = reinterpret_cast<const Bytef *>(packed.data());
    const Bytef *const from_end = from + packed.size();
    std::string all;
    for (std::uint64_t block = 0; block < n_blocks; ++block)
      {
        std::string bytes(block + 1 == n_blocks && of_last > 0 ? of_last : size, ' ');
        uLongf n = bytes.size();
        const int condition =
          uncompress(reinterpret_cast<Bytef *>(&bytes[0]), &n, from, number(header, 3 + block));
        if (condition != Z_OK || n != bytes.size())
          return "block " + std::to_string(block) + " is damaged";
        from += number(header, 3 + block);
        all += bytes;
      }
    return from == from_end ? all : "there is more than the header says";
  }


  void
  test_arrays()
  {
    std::printf("arrays\n");
    for (const std::size_t border :
         {0ul, 3ul, 65535ul, 65536ul, 2 * 65535ul, 262144ul, 3 * 262144ul})
      for (const std::size_t size : {border - 1, border, border + 1})
        {
          if (border == 0 && size == border - 1)
            continue;
          std::string bytes;
          std::uint32_t random = 1;
          for (std::size_t i = 0; i < size; ++i)
            bytes += char((random = 1664525 * random + 1013904223) >> 24);
          for (const Packing packing : {Packing::stored, Packing::compressed})
            {
              std::uint64_t n_blocks;
              const std::string text = vtk_array(bytes.data(), bytes.size(), packing);
              const bool same        = unpacked(text, n_blocks) == bytes;
              std::printf("  %s, %zu bytes, %d blocks: %s\n",
                          packing == Packing::stored ? "stored" : "compressed",
                          size,
                          int(n_blocks),
                          same ? "the same" : "NOT the same");
            }
        }
  }


  /** What stands in an array of a file. */
  template <class Value>
  std::vector<Value>
  array(const std::string &file, const std::string &name)
  {
    std::size_t begin = file.find("Name=\"" + name + "\"");
    begin             = file.find(">\n", begin) + 2;
    std::uint64_t n_blocks;
    const std::string bytes =
      unpacked(file.substr(begin, file.find('\n', begin) - begin), n_blocks);
    std::vector<Value> values(bytes.size() / sizeof(Value));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
    return values;
  }


  template <class Value>
  void
  print(const std::string &file, const std::string &name)
  {
    std::printf("  %s:", name.c_str());
    for (const Value value : array<Value>(file, name))
      std::printf(" %.17g", double(value));
    std::printf("\n");
  }


  /** A cell of each kind, far from the origin. */
  void
  test_kinds()
  {
    for (const auto &[type, n] :
         {std::pair<unsigned int, unsigned int>{5, 3}, {10, 4}, {22, 6}, {24, 10}})
      {
        std::printf("type %u\n", type);
        VtuCells cells{type, n, {}};
        std::vector<double> points;
        for (unsigned int a = 0; a < n; ++a)
          {
            cells.points.push_back(n - 1 - a);
            points.insert(points.end(), {1e6 + 1. / (a + 3), -1e9, a / 7.});
          }
        const std::vector<std::int32_t> material = {2000000011};
        const std::vector<float> stress          = {2.5e6f};
        const VtuPiece piece(cells, {{"material", &material}});
        const std::string file = piece.file({0.1, 7, points, {}, {{"stress", 1, &stress}}});
        print<std::int32_t>(file, "connectivity");
        print<std::int32_t>(file, "offsets");
        print<std::uint8_t>(file, "types");
        print<float>(file, "stress");
        print<std::int32_t>(file, "material");
        std::printf("  points are %s\n",
                    array<double>(file, "Points") == points ? "exact" : "NOT exact");
      }
  }


  void
  test_empty()
  {
    std::printf("no cells\n");
    const std::vector<double> points;
    const std::vector<float> none;
    const std::vector<std::int32_t> no_ids;
    const VtuPiece piece({10, 4, {}}, {{"material", &no_ids}});
    const VtuPiece::Instant now{
      0.5, 2, points, {{"displacement", 3, &none}}, {{"stress", 1, &none}}};
    std::printf("%s", piece.file(now).c_str());
    std::printf("%s", piece.record(now, {"a.0.vtu", "a.1.vtu"}).c_str());
  }
} // namespace


int
main()
{
  test_arrays();
  test_kinds();
  test_empty();
}
