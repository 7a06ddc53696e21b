#ifndef supple_mesh_search_h
#define supple_mesh_search_h

#include <supple/base/task_output.h>
#include <supple/study/study_plan.h>
#include <supple/study/study_quantities.h>
#include <supple/study/study_runner.h>
#include <supple/study/study_table.h>

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
     * cells are r times as large (Richardson 1911). Infinite while there is one mesh. */
    double
    error() const;

    /** p: between the last three meshes, or the lowest one that is believed. */
    double
    order() const;

    /** Whether three meshes have told the order. */
    bool
    order_is_known() const;

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
   * The soonest mesh on which the error in space of a scene is below an aim: its own mesh with edges
   * cut into 2, 3, 4, 6, ..., with linear and with quadratic cells, as far as the scene can have
   * them. The error is found from the distances of the results on three meshes.
   */
  class MeshSearch
  {
  public:
    /** A method in time with its step or tolerance, which the runs take; of static scenes without
     * overrides. */
    struct InTime
    {
      std::string label;
      std::vector<Override> overrides;
    };

    /** @param in_time those that are accurate enough, the soonest first: where one can't be had on
     * a mesh, such as an explicit one, the next one is taken */
    MeshSearch(const StudyPlan &plan,
               const StudyQuantities &quantities,
               const StudyRunner &runner,
               const TaskOutput &output,
               const std::vector<InTime> &in_time);

    /** A run whose error in space is below the aim. */
    struct Found
    {
      PlannedRun run;
      double error;   ///< in space, relative
      double order;   ///< with which it falls
      bool order_is_known;
      double seconds; ///< of the run
      unsigned int n_cells;
    };

    /** @param error_in_time on top of what is found, for the table
     * @return nothing if no mesh meets the aim */
    std::optional<Found>
    search(double aim, double error_in_time);

    const StudyTable &
    table() const
    {
      return found;
    }

  private:
    /** The meshes of one order of cells. */
    void
    climb(unsigned int order_of_cells, double aim, double error_in_time);

    /** A run on a mesh, by the first method in time that can be had. @return nothing if none can */
    std::optional<StudyRecord>
    record(unsigned int order_of_cells, unsigned int n_parts, StudyRow &row) const;

    PlannedRun
    planned(unsigned int order_of_cells, unsigned int n_parts, const InTime &method) const;

    /** The next of the meshes that are tried; 0 if there is none, or none that may win. */
    unsigned int
    next(unsigned int n_parts, const MeshLadder &ladder, double aim, const StudyRow &last) const;

    const StudyPlan &plan;
    const StudyQuantities &quantities;
    const StudyRunner &runner;
    const TaskOutput &output;
    const std::vector<InTime> in_time;
    StudyTable found;
    std::optional<Found> best;
  };
} // namespace Supple

#endif
