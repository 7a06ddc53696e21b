#ifndef supple_film_h
#define supple_film_h

#include <supple/output/body_surface.h>
#include <supple/output/packed_film.h>
#include <supple/output/vtu.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace Supple
{
  /**
   * The surface of the body in each frame, for the report page: the displacement of its vertices,
   * and volume ratio and von Mises stress of the cells behind its triangles; perhaps the pressure
   * of contact, the mean of their vertices, and the error in space of these cells.
   *
   * The frames are kept in a file of the output folder, report.frames, so that a run that goes on
   * from a checkpoint has those before it.
   */
  class Film
  {
  public:
    /** @param with_contact whether something may touch the body
     * @param with_errors   whether frames have errors in space; zero where they are unknown */
    Film(const Body &body, const std::string &folder, bool with_contact, bool with_errors);

    /** Its name in the folder. */
    static std::string
    file_name();

    /** Goes on after the first @p n_frames of a run; if they are not all there, begins here. */
    void
    resume(unsigned int n_frames);

    /** @throws WriteError on the first process */
    void
    write(const Drawing &drawing);

    /** All frames, or as many of them at equal distances, first and last included, as have room in
     * @p limit bytes. On the first process. */
    PackedFilm
    pack(std::size_t limit) const;

    /** Takes the file away. */
    void
    remove() const;

  private:
    /** A field of this process's triangles. @param name one of fields */
    std::vector<float>
    own_values(const std::string &name, const Drawing &drawing) const;

    /** The values of all triangles, field by field, on the first process; collective. */
    std::vector<float>
    gather_fields(const Drawing &drawing) const;

    void
    open(bool anew);

    std::size_t
    head_size() const;

    std::size_t
    frame_size() const;

    FilmFrame
    read_frame(std::ifstream &stream, unsigned int number) const;

    std::vector<FilmFrame>
    read_frames(unsigned int n_taken) const;

    const BodySurface surface;
    const MPI_Comm communicator;
    const std::string file;
    const std::vector<std::string> fields; ///< of the triangles, their names
    const std::string magic;               ///< how the file begins
    const bool root;
    std::ofstream stream;
    std::uint64_t n_missing = 0; ///< frames of the run that are not in the file, for they were lost
    unsigned int n_frames   = 0; ///< in the file
  };
} // namespace Supple

#endif
