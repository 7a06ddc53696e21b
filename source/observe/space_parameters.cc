#include <supple/observe/space_parameters.h>

#include <supple/input/entries.h>

namespace Supple
{
  void
  SpaceParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Space");
    Entries::add_choice(
      prm,
      "Estimate error",
      estimate,
      {{"end", Estimate::end}, {"frames", Estimate::frames}, {"never", Estimate::never}},
      "When the error that the mesh makes is estimated from the stress (doc/error.md). end: in the "
      "last state, for the end of the run, summary.json and the last frame. frames: at each frame "
      "too, with a field of the cells in the frames and a column in history.csv.");
    Entries::add_choice(
      prm,
      "Second mesh",
      second_mesh,
      {{"none", SecondMesh::none},
       {"coarser", SecondMesh::coarser},
       {"finer", SecondMesh::finer},
       {"linear", SecondMesh::linear}},
      "On which the same scene moves along, to tell the error of the mesh from the distance of the "
      "two (doc/error.md). coarser: cells twice as large, of generated shapes with even counts of "
      "cubes, squares, sectors, layers and intervals between rings; an eighth of the work, and "
      "where those counts can be halved twice a third run tells the order. finer: each cell is cut "
      "in eight (triangles in four), of every shape; at least eight times the work. linear: linear "
      "cells on the vertices of quadratic ones, for little work; their error, of which that of the "
      "quadratic cells is a small part, is told as a bound.");
    Entries::add(
      prm,
      "Aim",
      aim,
      "1",
      Range("0, or a number greater than 0 and less than 1",
            [](const std::string &text) {
              return Range::at_least(0).match(text) &&
                     (Range::between(0, 1).match(text) ||
                      !Range::between(0, Entries::infinity).match(text));
            }),
      "Of a static scene, such as 0.01: it is run again and again, on a mesh refined as "
      "by Mesh/Refine, until the relative error in space of that quantity is estimated to "
      "be no more than this; with Refine so many times at most. Without Refine: of the "
      "displacement of a probe that moves most, or of the energy if there is no probe. 0: "
      "one run.");
    prm.leave_subsection();
  }
} // namespace Supple
