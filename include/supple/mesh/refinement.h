#ifndef supple_refinement_h
#define supple_refinement_h

#include <supple/mesh/bisection.h>
#include <supple/mesh/mesh_parameters.h>

#include <functional>
#include <vector>

namespace Supple
{
  /** What a generator and Mesh/Map know of the body's shape beyond its cells. */
  struct BodyShape
  {
    Bisection::Middle middle;                                                ///< of an edge
    std::function<std::vector<dealii::Point<3>>(const SerialMesh &)> places; ///< of the vertices

    /** Gives faces their boundary ids by regions; finer meshes inherit them. */
    std::function<void(SerialMesh &)> name_boundaries;
  };


  /**
   * Refines a mesh where the scene says, gives its boundary the ids that the scene says, and then
   * refines it where pilot runs have found it too coarse.
   * @param mesh checked, before Mesh/Map
   * @throws InputError for a region without a cell, more cells than are allowed, or cells that
   * curved walls turn inside out
   */
  void
  refine(SerialMesh &mesh,
         const RefinementParameters &parameters,
         const BodyShape &shape,
         const ParameterFile &scene);


  /** The middle of a straight edge. */
  dealii::Point<3>
  middle_of_edge(const dealii::Point<3> &a, const dealii::Point<3> &b);


  /** The middle of an edge of a hollow cylinder about the z axis: as far from the axis as its ends
   * are on average. */
  dealii::Point<3>
  middle_around_axis(const dealii::Point<3> &a, const dealii::Point<3> &b);
} // namespace Supple

#endif
