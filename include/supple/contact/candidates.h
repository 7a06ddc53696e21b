#ifndef supple_candidates_h
#define supple_candidates_h

#include <supple/contact/contact_surface.h>
#include <supple/contact/tool.h>

#include <cstdint>
#include <vector>

namespace Supple
{
  /** Numbers of two parts that may touch: one of the surface, and one of a tool's core or of the
   * surface again. */
  struct Candidate
  {
    std::uint32_t one, other;
  };


  /** Parts that may touch, by their kinds. All are in an order that does not depend on what else is
   * near. A plane has one face, and no edges nor vertices. */
  struct Candidates
  {
    std::vector<Candidate> vertex_face;
    std::vector<Candidate> face_vertex; ///< none of the surface with itself
    std::vector<Candidate> edge_edge;   ///< none of a plane body with itself
    std::vector<Candidate> face_face;   ///< for places within the first one

    bool
    empty() const
    {
      return vertex_face.empty() && face_vertex.empty() && edge_edge.empty() && face_face.empty();
    }
  };


  /** Where the surface is, and a straight way that it goes. */
  struct SurfaceMotion
  {
    const double *u;             ///< displacement of all local nodes [m]
    const double *way = nullptr; ///< of all local nodes [m]; null: none
  };


  /** A tool's pose at the start and the end of a way. */
  struct ToolMotion
  {
    Pose from, to;
  };


  /** All parts whose gaps fall below a distance somewhere on the way [m]. Some others are among
   * them. */
  Candidates
  candidates_of(const ContactSurface &surface,
                const SurfaceMotion &motion,
                const Tool &tool,
                const ToolMotion &way,
                double distance);


  /** The same of the surface with itself, or only with that of other pieces of the mesh. Parts that
   * have a node in common do not touch. On one process. */
  Candidates
  own_candidates(const ContactSurface &surface,
                 const SurfaceMotion &motion,
                 bool only_other_pieces,
                 double distance);


  /** Those of own_candidates() that are nearer than a distance [m] where the surface is. */
  Candidates
  near_ones(const Candidates &candidates,
            const ContactSurface &surface,
            const double *u,
            double distance);
} // namespace Supple

#endif
