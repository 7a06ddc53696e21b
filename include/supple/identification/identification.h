#ifndef supple_identification_h
#define supple_identification_h

#include <supple/base/task_output.h>
#include <supple/identification/identification_fit.h>
#include <supple/identification/identification_table.h>
#include <supple/identification/layered_model.h>

#include <memory>

namespace Supple
{
  /**
   * Two layers of skin from the shape of its surface under a needle: the error of each pair of
   * thickness and elasticity ratio on a grid, and between them by an optimizer.
   *
   * Into its folder it writes identification.csv, identification.md, profiles.csv, fits.csv,
   * report.html, heat maps and the best profiles (SVG, PNG and the scripts of gnuplot they are made
   * by). One that fails or is interrupted leaves the same of what is done, with a note.
   */
  class Identification
  {
  public:
    /**
     * Reads measurements and scene.
     * @param quiet no words on the screen
     * @throws InputError
     */
    Identification(const IdentificationParameters &parameters,
                   const std::string &folder,
                   bool quiet,
                   MPI_Comm communicator);

    /** Builds the scene with each thickness, and solves nothing. @throws InputError */
    void
    check() const;

    /** @throws InputError, ComputationError, InterruptedError */
    void
    run();

  private:
    /** All pairs, thickness in the outer loop. */
    void
    search_grid();

    /** Depths and errors of all sets.
     * @param starts where the thesis's correction begins; the depths found, afterwards [m] */
    PairErrors
    errors_of(const LayerPair &pair, std::vector<double> &starts) const;

    void
    fit();

    /** Measured and computed surface of each set, with its own best pair. */
    void
    compare_best();

    /** Tables and plots of what there is. */
    void
    write() const;

    const IdentificationParameters parameters;
    TaskOutput output;
    const std::vector<MeasuredSet> sets;
    const LayeredModel model;
    IdentificationTable table;
  };
} // namespace Supple

#endif
