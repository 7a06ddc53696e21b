#ifndef supple_mesh_search_h
#define supple_mesh_search_h

#include <supple/study/aim_curve.h>
#include <supple/study/study_plan.h>
#include <supple/study/study_quantities.h>
#include <supple/study/study_runner.h>
#include <supple/study/study_table.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Supple
{
  /** Errors of one mesh after the other, and the order with which they fall. */
  class MeshLadder
  {
  public:
    /** @param lowest, highest orders that are believed */
    MeshLadder(double lowest, double highest);

    /** @param n_parts  into how many each edge of the first mesh is cut
     *  @param distance of the results from those on the mesh before, relative; of the first mesh
     * none */
    void
    add(unsigned int n_parts, double distance);

    /** Of the last mesh, relative: d / (r^p - 1) with the distance d from the mesh before, whose
     * cells are r times as large (Richardson 1911). Infinite while there is one mesh, or where
     * three meshes show an order below the lowest one. */
    double
    error() const;

    /** The same over the distance. */
    double
    error_over_distance() const;

    /** p: between the last three meshes, within the orders that are believed; the lowest one while
     * there are two. */
    double
    order() const;

    /** Whether three meshes have told the order. */
    bool
    order_is_known() const;

    /** Whether the distances have risen twice. */
    bool
    diverges() const;

    /** Into how many parts edges have to be cut for an error. */
    double
    parts_for(double wanted) const;

  private:
    struct Step
    {
      double size; ///< of the cells, over that of the first mesh
      double distance;
    };

    const double lowest, highest;
    std::vector<Step> steps;
  };


  /**
   * The soonest mesh on which the error in space of a scene is below an aim: its own mesh with
   * edges cut into 2, 3, 4, 6, ..., with linear and with quadratic cells, as far as the scene can
   * have them. The error is found from the distances of the results on three meshes.
   */
  class MeshSearch
  {
  public:
    /** A method in time with its step or tolerance, which the runs take; of static scenes a run
     * without overrides. */
    struct InTime
    {
      PlannedRun run;
      double error;         ///< relative, that of the reference included
      double price_of_half; ///< how many times the run time half of it takes
    };

    /**
     * @param in_time   those that are accurate enough, the soonest first: where one can't be had on
     *                  a mesh, such as an explicit one, the next one is taken
     * @param aim       of the errors in space and in time together, relative
     * @param after_run is called with all runs so far after each of them
     */
    MeshSearch(const StudyPlan &plan,
               const StudyQuantities &quantities,
               const StudyRunner &runner,
               const std::vector<InTime> &in_time,
               double aim,
               const std::function<void(const StudyTable &)> &after_run);

    /** A run whose error is below the aim. */
    struct Found
    {
      PlannedRun run;
      double error; ///< in space, relative
      double order; ///< with which it falls
      bool order_is_known;
      double error_in_time; ///< relative
      double price_of_half; ///< how many times the run time half of both takes
      double seconds;       ///< of the run
      unsigned int n_cells;
    };

    /** @return nothing if no mesh meets the aim */
    std::optional<Found>
    search();

  private:
    /** The meshes of one order of cells, from coarse to fine. */
    struct Climb
    {
      Climb(const unsigned int order_of_cells, const MeshLadder &ladder)
        : order_of_cells(order_of_cells)
        , ladder(ladder)
      {
      }

      unsigned int order_of_cells;
      MeshLadder ladder;
      std::optional<StudyRecord> before;
      unsigned int n_parts = 0; ///< of the last mesh
      unsigned int n_cells = 0;
      double dimension     = 3.;
      double seconds       = 0.; ///< of its run
      unsigned int next    = 1;  ///< parts of the next mesh; 0: none
      double expected      = 0.; ///< seconds of its run
    };

    /** Runs the next mesh. */
    void
    step(Climb &climb);

    /** A run on a mesh, by the first method in time that can be had. @return nothing if none can */
    std::optional<StudyRecord>
    record(unsigned int order_of_cells,
           unsigned int n_parts,
           StudyRow &row,
           const InTime *&method) const;

    PlannedRun
    planned(unsigned int order_of_cells, unsigned int n_parts, const PlannedRun &method) const;

    /** Relative errors, in space and in time, one for each quantity. */
    std::vector<double>
    errors(const MeshLadder &ladder,
           const std::vector<double> &distances,
           double error_in_time) const;

    /** Adds a run to the table, and tells of it. */
    void
    add(const StudyRow &row);

    /** From how the number of cells grows. */
    static double
    dimension_of(const Climb &climb, unsigned int n_parts, unsigned int n_cells);

    void
    choose_next(Climb &climb) const;

    /** Whether the next mesh of a climb may be sooner than the best one. */
    bool
    may_win(const Climb &climb) const;

    const StudyPlan &plan;
    const StudyQuantities &quantities;
    const StudyRunner &runner;
    const std::vector<InTime> in_time;
    const double aim;
    const std::function<void(const StudyTable &)> after_run;
    double seconds = 0.; ///< of all runs
    StudyTable found;
    std::optional<Found> best;
  };
} // namespace Supple

#endif
