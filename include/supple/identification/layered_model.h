#ifndef supple_layered_model_h
#define supple_layered_model_h

#include <supple/identification/identification_fit.h>
#include <supple/identification/identification_parameters.h>
#include <supple/scene/parameters.h>

#include <deal.II/base/mpi.h>

namespace Supple
{
  /** The scene of an identification as a function of its two layers. */
  class LayeredModel
  {
  public:
    /** @throws InputError if the scene is not linear in the depth of the needle, or has no such
     * profile */
    LayeredModel(const IdentificationParameters &identification, MPI_Comm communicator);

    /**
     * Builds the scene with this pair and checks that its surface reaches what was measured.
     * @throws InputError
     */
    void
    check(const LayerPair &pair, const std::vector<MeasuredSet> &sets) const;

    /**
     * The surface per depth of the needle: one solution, whatever the number of sets. The same on
     * all processes.
     * @throws InputError if the layers don't fit to the mesh, ComputationError
     */
    SurfaceResponse
    surface(const LayerPair &pair) const;

    const Parameters base;

  private:
    /** Thicknesses of the layers, and the material of the lower one, as a scene has them. */
    std::pair<std::string, std::string>
    layers(const LayerPair &pair) const;

    /** The scene with this pair, read and checked. @throws InputError */
    Parameters
    read_scene(const LayerPair &pair) const;

    /** The same, unchecked. */
    Parameters
    scene(const LayerPair &pair) const;

    /** Of the body [m]. */
    double
    height() const
    {
      return base.mesh.height_and_rows().first;
    }

    void
    check_linear() const;

    void
    check_layers() const;

    void
    check_profile() const;

    /** @throws InputError for a measured depth that the body does not have */
    void
    check_depths(const std::vector<MeasuredSet> &sets) const;

    /** @throws InputError if the needle is not on the surface */
    void
    check_center(const std::vector<SurfaceResponse::Vertex> &line) const;

    /** @param needle how deep the surface is at the center [m]
     * @throws InputError if that is not down, or if it is deeper somewhere else */
    void
    check_needle(const std::vector<SurfaceResponse::Vertex> &line, double needle) const;

    /** Vertices of the surface in line with the needle, from rows of the profile. */
    std::vector<SurfaceResponse::Vertex>
    line_of(const std::vector<std::vector<double>> &rows) const;

    const IdentificationParameters &identification;
    const MPI_Comm communicator;
  };
} // namespace Supple

#endif
