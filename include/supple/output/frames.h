#ifndef supple_frames_h
#define supple_frames_h

#include <supple/forces/forces.h>
#include <supple/observe/measurement.h>
#include <supple/observe/space_error.h>
#include <supple/output/film.h>
#include <supple/output/output_parameters.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** Frames of the moving body for ParaView: decides when one is due and writes it. */
  class Frames
  {
  public:
    /** @param folder of the results; solution.pvd goes there and VTU files into solution/ below
     * it, and if a report is wanted, the film that it shows
     * @param errors of the cells, which a frame of that step has too; null if there are none
     * @param of_all_frames whether each frame has them, so that the film has them too */
    Frames(const Configuration &configuration,
           const Forces &forces,
           const OutputParameters &parameters,
           const std::string &folder,
           const CellErrors *errors,
           bool of_all_frames);

    /** The patterns of their names in the folder, those of the film included. */
    static std::vector<std::string>
    files();

    /** Whether something has happened that should be seen. */
    bool
    due(const Measurement &now) const;

    /**
     * Whether a frame, whose numbers have 32 bits, can hold the state: none becomes infinite. What
     * was computed for that is kept for write() of the same step. Collective.
     */
    bool
    can_hold(unsigned int step);

    /** Writes the state, unless it was written already. The rotations must be those of the state.
     */
    void
    write(const Measurement &now);

    /** What a checkpoint has to keep of it beside displacement_of_last(). */
    nlohmann::json
    save() const;

    void
    load(const nlohmann::json &saved);

    Vector &
    displacement_of_last()
    {
      return last_displacement;
    }

    /** Null if no report is wanted. */
    const Film *
    surface_film() const
    {
      return film.get();
    }

    unsigned int
    n_written() const
    {
      return records.size();
    }

  private:
    bool
    has_moved(const Vector &displacement) const;

    bool
    volume_has_changed(const Measurement &now) const;

    bool
    is_written(unsigned int step) const;

    /** Those of the present state; computed once for each step. */
    const CellFields &
    fields(unsigned int step);

    /** What names the files of all frames with their times, as solution.pvd does. */
    std::string
    collection(const std::vector<std::string> &files) const;

    /** Draws the tools as they are in the last frame; on the first process. */
    void
    write_tools() const;

    /** Writes the files of this frame. */
    void
    draw_state(const Measurement &now, const std::string &name);

    void
    write_pieces(const Drawing &drawing, const std::string &name) const;

    const Configuration &configuration;
    const Forces &forces;
    const Body &body;
    const OutputParameters &parameters;
    const std::string folder;
    const CellErrors *const errors;
    const Vtu vtu;
    std::unique_ptr<Film> film;
    std::vector<std::pair<double, std::string>> records; ///< time and file of each frame
    Measurement last;                                    ///< when the last frame was written
    Vector last_displacement;
    double min_volume_ratio, max_volume_ratio; ///< of all frames
    bool inverted = false;                     ///< in any frame
    std::optional<CellFields> cells;           ///< of a step that is not written yet
    unsigned int step_of_cells = 0;
  };
} // namespace Supple

#endif
