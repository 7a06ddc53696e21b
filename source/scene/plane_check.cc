#include <supple/scene/plane_check.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Supple
{
  namespace
  {
    constexpr const char *out_of_plane =
      ": the body lies in the plane z = 0 and does not leave it; the third component must be 0.";
    constexpr const char *not_symmetric =
      ": an axisymmetric body looks the same from all sides; along x, away from the axis, it must "
      "be 0.";

    /** Refuses expressions whose third component is not the number 0. */
    void
    check_third_component(const std::string &text, const std::string &origin)
    {
      const auto components = dealii::Utilities::split_string_list(text, ';');
      if (components.size() == 3 && !Expression::says_zero(components[2]))
        throw InputError(origin + out_of_plane);
    }


    void
    check_plane(const Parameters &parameters)
    {
      const LoadParameters &loads  = parameters.loads;
      const StartParameters &start = parameters.start;
      for (const auto &[entry, text] : std::vector<std::pair<std::string, std::string>>{
             {"Loads/Body force", loads.body_force},
             {"Loads/Nodal force", loads.nodal_force},
             {"Loads/Traction", loads.traction},
             {"Start/Displacement", start.displacement},
             {"Start/Velocity", start.velocity}})
        check_third_component(text, parameters.origin(entry));
      for (unsigned int m = 0; m < parameters.motions.size(); ++m)
        {
          const auto components =
            dealii::Utilities::split_string_list(parameters.motions[m].displacement, ';');
          if (components.size() == 3 && components[2] != "free")
            check_third_component(parameters.motions[m].displacement,
                                  parameters.origin(Parameters::motion_section(m) +
                                                    "/Displacement"));
        }
      if (loads.gravity[2] != 0.)
        throw InputError(parameters.origin("Loads/Gravity") + out_of_plane);
      if (start.rotation[0] != 0. || start.rotation[1] != 0.)
        throw InputError(parameters.origin("Start/Rotation") +
                         ": the body lies in the plane z = 0 and turns about z alone; the first "
                         "two components must be 0.");
    }
  } // namespace


  void
  check_directions(const Parameters &parameters, const Section &section)
  {
    if (section.plane())
      check_plane(parameters);
    else
      {
        const Section preset;
        const Section &unused   = parameters.plane.section;
        const std::string words = ": it is for bodies of triangles; this one has tetrahedra.";
        if (unused.geometry != PlaneParameters().section.geometry)
          throw InputError(parameters.origin("Plane/Model") + words);
        if (unused.thickness != preset.thickness)
          throw InputError(parameters.origin("Plane/Thickness") + words);
      }
    if (section.axisymmetric())
      {
        if (parameters.loads.gravity[0] != 0.)
          throw InputError(parameters.origin("Loads/Gravity") + not_symmetric);
        if (parameters.start.rotation.norm() != 0.)
          throw InputError(parameters.origin("Start/Rotation") +
                           ": an axisymmetric body can't be turned; it must be 0, 0, 0.");
      }
  }


  void
  fit_to_axis(SerialMesh &mesh, const Parameters &parameters)
  {
    double width = 0., smallest = 0.;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (const unsigned int v : mesh.cell_vertices(c))
        {
          width    = std::max(width, mesh.vertices[v][0]);
          smallest = std::min(smallest, mesh.vertices[v][0]);
        }
    if (smallest < -1e-9 * width || width <= 0.)
      {
        const bool from_file = parameters.mesh.shape == MeshParameters::Shape::file;
        std::ostringstream text;
        text << parameters.origin(from_file ? "Mesh/File" : "Mesh/Rectangle origin")
             << ": the body is axisymmetric, and x is the distance from the axis; it can't be "
                "negative. The smallest one is "
             << smallest << " m.";
        throw InputError(text.str());
      }
    for (auto &vertex : mesh.vertices)
      if (std::abs(vertex[0]) <= 1e-9 * width)
        vertex[0] = 0.;
  }
} // namespace Supple
