#ifndef supple_body_surface_h
#define supple_body_surface_h

#include <supple/mechanics/body.h>

#include <array>
#include <vector>

namespace Supple
{
  /**
   * What can be seen of the body: the triangles of its surface, four of each face of a quadratic
   * cell, those of a plane body being all its cells. Vertices are sorted by their index in the mesh
   * before partitioning, and triangles by their vertices: the number of processes may change.
   */
  class BodySurface
  {
  public:
    /** Collective. */
    explicit BodySurface(const Body &body);

    /** Three displacements of each vertex [m], on the first process. Collective. */
    std::vector<float>
    gathered(const Vector &displacement) const;

    struct Triangle
    {
      std::array<unsigned int, 3> nodes; ///< local numbers
      unsigned int cell_index, material;
    };
    std::vector<Triangle> own_triangles; ///< of this process

    // On the first process: the surface as a whole, and where each number that is gathered belongs.
    std::vector<float> rest; ///< places of the vertices [m]
    std::vector<std::array<unsigned int, 3>> triangles;
    std::vector<unsigned int> materials;     ///< of the triangles
    std::vector<unsigned int> index_in_mesh; ///< of the vertices
    std::vector<unsigned int> triangle_place;

  private:
    /** This process's part of it. */
    void
    find(const Body &body);

    void
    gather(const Body &body);

    /** @param vertices of all processes one after the other, with their @p positions; @p corners of
     * the triangles are of these vertices too */
    void
    sort(std::vector<unsigned int> vertices,
         const std::vector<float> &positions,
         const std::vector<unsigned int> &corners,
         const std::vector<unsigned int> &unsorted_materials);

    const MPI_Comm communicator;
    std::vector<unsigned int> own_nodes; ///< on the surface, owned by this process
    std::vector<unsigned int> vertex_place;
  };
} // namespace Supple

#endif
