#include <supple/output/packed_film.h>

#include <supple/base/compression.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace Supple
{
  namespace
  {
    template <class Value>
    void
    append(std::vector<unsigned char> &bytes, const std::vector<Value> &values)
    {
      const auto *const begin = reinterpret_cast<const unsigned char *>(values.data());
      bytes.insert(bytes.end(), begin, begin + values.size() * sizeof(Value));
    }


    /** Values in 16 bits that stand for a range; what lies beyond is cut off. */
    void
    append_in_16_bits(std::vector<std::uint16_t> &bits,
                      const float *value,
                      const float *const end,
                      const std::array<double, 2> &range,
                      const std::array<long, 2> &numbers)
    {
      const double width = range[1] - range[0];
      const double scale = width > 0. ? (numbers[1] - numbers[0]) / width : 0.;
      for (; value != end; ++value)
        bits.push_back(std::clamp(std::lround(numbers[0] + scale * (*value - range[0])),
                                  numbers[0],
                                  numbers[1]));
    }


    /** Bytes that zlib packs well, for values that change little from frame to frame. */
    void
    append_differences(std::vector<unsigned char> &bytes,
                       const std::vector<std::uint16_t> &values,
                       const std::vector<std::uint16_t> &before)
    {
      const std::size_t begin = bytes.size(), n = values.size();
      bytes.resize(begin + 2 * n);
      for (std::size_t i = 0; i < n; ++i)
        {
          const auto difference =
            static_cast<std::int16_t>(values[i] - (before.empty() ? 0 : before[i]));
          const auto folded =
            static_cast<std::uint16_t>(difference < 0 ? -2 * difference - 1 : 2 * difference);
          bytes[begin + i]     = folded & 0xff;
          bytes[begin + n + i] = folded >> 8;
        }
    }


    void
    widen(std::array<double, 2> &range, const float *const begin, const float *const end)
    {
      const auto [low, high] = std::minmax_element(begin, end);
      range = {{std::min<double>(range[0], *low), std::max<double>(range[1], *high)}};
    }
  } // namespace


  PackedFilm::PackedFilm(const std::vector<float> &rest,
                         const std::vector<std::array<unsigned int, 3>> &triangles,
                         const std::vector<unsigned int> &materials_of_triangles,
                         const std::vector<std::string> &fields)
    : fields(fields)
    , n_vertices(rest.size() / 3)
    , n_triangles(triangles.size())
    , ranges(fields.size())
  {
    const std::set<unsigned int> different(materials_of_triangles.begin(),
                                           materials_of_triangles.end());
    materials.assign(different.begin(), different.end());
    std::vector<std::uint16_t> places;
    for (const unsigned int id : materials_of_triangles)
      places.push_back(std::lower_bound(materials.begin(), materials.end(), id) -
                       materials.begin());
    places.resize((places.size() + 1) / 2 * 2);
    append(bytes, rest);
    append(bytes, triangles);
    append(bytes, places);
    n_surface_bytes = bytes.size();
  }


  void
  PackedFilm::set_frames(const std::vector<FilmFrame> &frames)
  {
    set_ranges(frames);
    std::vector<std::uint16_t> before;
    std::vector<unsigned char> plain;
    for (const FilmFrame &frame : frames)
      {
        std::vector<std::uint16_t> values;
        values.reserve(frame.displacement.size() + frame.cells.size());
        const float *const u     = frame.displacement.data();
        const float *const cells = frame.cells.data();
        append_in_16_bits(values,
                          u,
                          u + 3 * n_vertices,
                          {{-largest_displacement, largest_displacement}},
                          {{-32767, 32767}});
        for (std::size_t f = 0; f < ranges.size(); ++f)
          append_in_16_bits(values,
                            cells + f * n_triangles,
                            cells + (f + 1) * n_triangles,
                            ranges[f],
                            {{0, 65535}});
        append_differences(plain, values, before);
        before = std::move(values);
      }
    bytes.resize(n_surface_bytes);
    const std::string packed = compressed(plain.data(), plain.size());
    bytes.insert(bytes.end(), packed.begin(), packed.end());
  }


  void
  PackedFilm::set_ranges(const std::vector<FilmFrame> &frames)
  {
    times.clear();
    steps.clear();
    largest_displacement = 0.;
    std::fill(ranges.begin(),
              ranges.end(),
              std::array<double, 2>{
                {std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()}});
    for (const FilmFrame &frame : frames)
      {
        times.push_back(frame.time);
        steps.push_back(frame.step);
        const float *const cells = frame.cells.data();
        for (std::size_t f = 0; f < ranges.size(); ++f)
          widen(ranges[f], cells + f * n_triangles, cells + (f + 1) * n_triangles);
        for (const float u : frame.displacement)
          largest_displacement = std::max<double>(largest_displacement, std::abs(u));
      }
  }


  nlohmann::ordered_json
  PackedFilm::description() const
  {
    nlohmann::ordered_json json = {{"vertices", n_vertices},
                                   {"triangles", n_triangles},
                                   {"frames_written", n_written},
                                   {"times", times},
                                   {"steps", steps},
                                   {"largest_displacement", largest_displacement}};
    for (std::size_t f = 0; f < ranges.size(); ++f)
      json[fields[f]] = ranges[f];
    json["materials"] = materials;
    return json;
  }
} // namespace Supple
