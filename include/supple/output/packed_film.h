#ifndef supple_packed_film_h
#define supple_packed_film_h

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace Supple
{
  /** The surface of the body in one frame. */
  struct FilmFrame
  {
    double time, step;
    std::vector<float> displacement; ///< 3 for each vertex [m]
    std::vector<float> cells;        ///< values of all triangles, field by field
  };


  /**
   * What the report page needs to draw the body: a description, and bytes of which it tells the
   * places, all little-endian: rest positions (3 float each), triangles (3 uint32), the place of
   * their material among those that occur (1 uint16, one more if their number is odd), and a zlib
   * stream of the frames. The values of a frame are displacements (3 int16 each), and then field by
   * field those of the triangles (uint16). The stream has their differences d from the frame
   * before, as 2 d or -2 d - 1 (uint16): the low bytes of a frame, then its high ones.
   */
  class PackedFilm
  {
  public:
    /** @param rest positions, 3 for each vertex [m]
     * @param fields names of those of the triangles */
    PackedFilm(const std::vector<float> &rest,
               const std::vector<std::array<unsigned int, 3>> &triangles,
               const std::vector<unsigned int> &materials_of_triangles,
               const std::vector<std::string> &fields);

    /** In place of those that were set before. @throws WriteError */
    void
    set_frames(const std::vector<FilmFrame> &frames);

    nlohmann::ordered_json
    description() const;

    unsigned int n_written = 0; ///< frames of the run, of which some may be left out
    std::vector<unsigned char> bytes;

  private:
    void
    set_ranges(const std::vector<FilmFrame> &frames);

    std::vector<std::string> fields;
    std::size_t n_vertices, n_triangles, n_surface_bytes;
    std::vector<double> times;                 ///< [s]
    std::vector<double> steps;                 ///< in which they were reached
    double largest_displacement = 0.;          ///< of a component [m]; 32767 stands for it
    std::vector<std::array<double, 2>> ranges; ///< of each field, for 0 and 65535
    std::vector<unsigned int> materials;       ///< ids that occur
  };
} // namespace Supple

#endif
