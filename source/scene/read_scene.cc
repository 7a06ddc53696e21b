#include <supple/scene/read_scene.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/mechanics/selection.h>

#include <deal.II/base/utilities.h>

#include <sstream>
#include <tuple>

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
             {"Loads/Gravity", loads.gravity_expressions()},
             {"Start/Displacement", start.displacement},
             {"Start/Velocity", start.velocity}})
        check_third_component(text, parameters.origin(entry));
      for (unsigned int m = 0; m < parameters.motions.size(); ++m)
        {
          const auto components =
            dealii::Utilities::split_string_list(parameters.motions[m].displacement, ';');
          if (components.size() == 3 && components[2] != "free")
            check_third_component(parameters.motions[m].displacement,
                                  parameters.origin(motion_section(m) + "/Displacement"));
        }
      if (start.rotation[0] != 0. || start.rotation[1] != 0.)
        throw InputError(parameters.origin("Start/Rotation") +
                         ": the body lies in the plane z = 0 and turns about z alone; the first "
                         "two components must be 0.");
    }


    /** A static problem has neither velocity nor damping; an explicit method needs a diagonal mass
     * matrix. */
    void
    check_problem(const Parameters &parameters)
    {
      const TimeParameters &time         = parameters.time;
      const MaterialParameters &material = parameters.material;
      if (time.is_explicit() && !material.lumped && material.vertex_mass == 0.)
        throw InputError(
          parameters.origin("Time/Method") +
          ": an explicit method needs a diagonal mass matrix: Material/Mass = lumped.");
      if (time.problem != TimeParameters::Problem::stationary)
        {
          if (parameters.space.aim > 0.)
            throw InputError(parameters.origin("Space/Aim") +
                             ": only a static scene can aim at an error in space (Time/Problem = "
                             "static); a dynamic one can be refined so many times (Mesh/Refine).");
          return;
        }
      if (parameters.space.aim > 0. &&
          parameters.space.estimate == SpaceParameters::Estimate::never)
        throw InputError(parameters.origin("Space/Estimate error") +
                         ": without an estimate nobody can say whether " +
                         parameters.origin("Space/Aim") + " is met; it must be end or frames.");
      if (parameters.damping.any())
        throw InputError(
          parameters.origin("Time/Problem") +
          ": a static problem knows no velocity; take the damping out of the scene.");
      const std::string velocity = parameters.origin("Start/Velocity");
      if (!Expression(parameters.start.velocity, 3, velocity).is_zero())
        throw InputError(velocity + ": a static problem (" + parameters.origin("Time/Problem") +
                         ") knows no velocity; it must be 0; 0; 0.");
    }


    /** Where the matrix is taken anew in each step, a tolerance of its rotations means nothing. */
    void
    check_warp_tolerance(const Parameters &parameters)
    {
      if (parameters.corotation.warp_tolerance == 0.)
        return;
      const std::string origin   = parameters.origin("Corotation/Warp tolerance");
      const TimeParameters &time = parameters.time;
      if (time.problem == TimeParameters::Problem::stationary)
        throw InputError(origin + ": a static problem takes its matrix anew; it must be 0.");
      if (parameters.material.cure != MaterialParameters::LockingCure::none)
        throw InputError(origin +
                         ": with a volumetric locking cure the matrix is taken anew in each step; "
                         "it must be 0.");
      if (time.is_semi_implicit())
        throw InputError(origin + ": " + time.method_name() +
                         " keeps its matrix as Time/Renewal angle says; it must be 0.");
      if (parameters.corotation.rotation == RotationMethod::polar &&
          time.method != TimeMethod::backward_euler && time.tangent != Tangent::frozen)
        throw InputError(origin + ": " + time.method_name() +
                         " takes the derivatives of the rotations, which change with the stress; "
                         "it must be 0, or Time/Tangent = frozen.");
    }


    /** Where the first friction is set; nothing without. */
    std::string
    place_of_friction(const Parameters &parameters)
    {
      for (const ToolParameters &tool : parameters.tools)
        if (tool.friction > 0.)
          return parameters.origin(tool.section() + "/Friction");
      const ContactParameters &contact = parameters.contact;
      return contact.between_bodies() && contact.friction > 0.
               ? parameters.origin("Contact/Friction")
               : "";
    }


    /** Only a method whose steps end with a stage keeps bodies apart: what others make of their
     * stages may be within a tool. */
    void
    check_contact(const Parameters &parameters)
    {
      const TimeParameters &time = parameters.time;
      if (!parameters.has_contact() || time.problem == TimeParameters::Problem::stationary)
        return;
      const std::string friction = place_of_friction(parameters);
      if (!friction.empty() && time.ends_with_stage() && time.order() > 1)
        throw InputError(friction +
                         ": friction is that of the touches at the start of a step, an error "
                         "of first order; " +
                         parameters.origin("Time/Method") +
                         " would gain nothing. Take backward euler or implicit backward euler.");
      if (time.method == TimeMethod::esdirk5)
        throw InputError(parameters.origin("Time/Method") +
                         ": its first stages go far beyond what comes, so that the energy grows "
                         "without bounds where tools are met. Take trbdf2, esdirk3 or esdirk4.");
      if (time.ends_with_stage())
        return;
      const std::string what = parameters.tools.empty()
                                 ? "bodies that meet each other (Contact/Bodies)"
                                 : "tools (subsection " + parameters.tools[0].section() + ")";
      throw InputError(parameters.origin("Time/Method") + ": with " + what +
                       " a step must end with an implicit stage, or the body may end within "
                       "something. Take backward euler, implicit backward euler, trbdf2, esdirk3 "
                       "or esdirk4.");
    }


    /** Whether a nodal force acts on more than a vertex that is chosen. */
    bool
    acts_on_each_vertex(const Parameters &parameters)
    {
      const LoadParameters &loads = parameters.loads;
      return !Expression(loads.nodal_force, 3, parameters.origin("Loads/Nodal force")).is_zero() &&
             after_word(loads.nodal_force_on, vertex_word).empty() &&
             after_word(loads.nodal_force_on, point_word).empty();
    }


    /** What each vertex has by itself is more on a finer mesh, so that errors of the mesh mean
     * nothing. */
    void
    check_other_meshes(const Parameters &parameters)
    {
      std::string asks;
      if (parameters.space.second_mesh != SpaceParameters::SecondMesh::none)
        asks = "Space/Second mesh";
      else if (!parameters.mesh.refinement.by.empty())
        asks = "Mesh/Refine";
      else if (parameters.space.aim > 0.)
        asks = "Space/Aim";
      else if (!parameters.mesh.refinement.region.empty())
        asks = "Mesh/Refine region";
      else
        return;
      const bool forces = acts_on_each_vertex(parameters);
      for (const auto &[by_vertex, entry, instead] :
           {std::make_tuple(forces, "Loads/Nodal force", "take Loads/Traction or Loads/Body force"),
            std::make_tuple(parameters.material.vertex_mass > 0.,
                            "Material/Mass per vertex",
                            "take Material/Density"),
            std::make_tuple(parameters.damping.viscous > 0.,
                            "Damping/Viscous",
                            "take Damping/Mass factor")})
        if (by_vertex)
          throw InputError(parameters.origin(asks) +
                           ": a mesh with more vertices is another body " +
                           "where each vertex has its own share (" + parameters.origin(entry) +
                           "); " + instead + ".");
    }


    /** What quadratic cells can't do. */
    void
    check_order(const Parameters &parameters)
    {
      if (parameters.mesh.order == 1)
        return;
      const std::string order = " (" + parameters.origin("Mesh/Order") + ")";
      if (parameters.material.vertex_mass > 0.)
        throw InputError(parameters.origin("Material/Mass per vertex") +
                         ": it is for linear cells; quadratic ones" + order +
                         " have other masses at the middles of edges than at vertices. It must be "
                         "0.");
      if (parameters.damping.viscous > 0.)
        throw InputError(parameters.origin("Damping/Viscous") +
                         ": it is for the vertices of linear cells; quadratic ones" + order +
                         " have more nodes. Take Damping/Mass factor.");
      if (acts_on_each_vertex(parameters))
        throw InputError(parameters.origin("Loads/Nodal force") +
                         ": a force on each of several vertices is for linear cells; quadratic "
                         "ones" +
                         order + " have more nodes. Take Loads/Traction or Loads/Body force.");
    }


    /** What means something for rotations alone, and a law by energy has none. */
    void
    check_law(const Parameters &parameters)
    {
      const MaterialParameters &material = parameters.material;
      const TimeParameters &time         = parameters.time;
      if (!material.law_choice().is_hyperelastic())
        return;
      const bool moves      = time.problem != TimeParameters::Problem::stationary;
      const std::string law = " (" + parameters.origin("Material/Law") + " = " + material.law + ")";
      const auto refuse     = [&](const std::string &entry, const std::string &words) {
        throw InputError(parameters.origin(entry) + ": " + words);
      };
      if (moves && (time.method == TimeMethod::backward_euler || time.is_semi_implicit()))
        refuse("Time/Method",
               time.method_name() +
                 " solves one linear system for rotations that are held, and "
                 "this law has none" +
                 law + ". Take " +
                 (time.is_semi_implicit() ? "esdirk3, esdirk4 or trbdf2."
                                          : "implicit backward euler or trbdf2."));
      if (parameters.corotation.rotation != CorotationParameters().rotation)
        refuse("Corotation/Rotation",
               "this law has no rotations" + law +
                 "; leave the entry out. Linear elasticity is Law = corotational with none.");
      if (parameters.corotation.warp_tolerance != 0.)
        refuse("Corotation/Warp tolerance", "this law has no rotations" + law + "; it must be 0.");
      if (time.tangent == Tangent::frozen)
        refuse("Time/Tangent",
               "this law has no rotations that could be held" + law +
                 "; it must be auto, consistent or definite.");
      if (parameters.damping.stiffness_factor > 0.)
        refuse("Damping/Stiffness factor",
               "it is for stresses that are linear in the strain, and this law's are not" + law +
                 ". Take Damping/Mass factor or Damping/Viscous.");
      if (material.volume_measure != VolumeMeasure::determinant)
        refuse("Material/Volume change",
               "its trace is taken with the rotation of a cell, and this law has none" + law +
                 "; it must be determinant.");
    }


    void
    check(const Parameters &parameters)
    {
      check_order(parameters);
      parameters.material.check(parameters.file);
      parameters.mesh.check(parameters.file);
      parameters.time.check(parameters.file);
      parameters.plane.check(parameters.file);
      check_law(parameters);
      check_warp_tolerance(parameters);
      check_problem(parameters);
      check_contact(parameters);
      check_other_meshes(parameters);
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
    if (section.geometry == Geometry::plane_stress &&
        parameters.material.law_choice().is_hyperelastic())
      throw InputError(parameters.origin("Material/Law") + ": " + parameters.material.law +
                       " does not know how thin a body in plane stress gets as it is stretched. "
                       "Take Plane/Model = plane strain or axisymmetric, tetrahedra, or Law = "
                       "corotational.");
    if (section.geometry == Geometry::plane_stress &&
        parameters.material.cure == MaterialParameters::LockingCure::patches)
      throw InputError(parameters.origin("Material/Volumetric locking cure") +
                       ": in plane stress nothing locks, and there are no patches; it must be "
                       "none.");
    if (section.axisymmetric())
      {
        const std::string gravity = parameters.loads.gravity_expressions();
        if (!Expression::says_zero(gravity.substr(0, gravity.find(';'))))
          throw InputError(parameters.origin("Loads/Gravity") + not_symmetric);
        if (parameters.start.rotation.norm() != 0.)
          throw InputError(parameters.origin("Start/Rotation") +
                           ": an axisymmetric body can't be turned; it must be 0, 0, 0.");
      }
  }


  Mesh
  make_mesh(const Parameters &parameters, const MPI_Comm communicator)
  {
    Mesh mesh(parameters.mesh,
              parameters.plane,
              parameters.material.cure == MaterialParameters::LockingCure::patches,
              parameters.file,
              communicator);
    check_directions(parameters, mesh.section);
    return mesh;
  }


  Parameters
  read_scene(const std::string &file, const std::vector<Override> &overrides)
  {
    return read_scene(ParameterFile(file), overrides);
  }


  Parameters
  read_scene(const ParameterFile &file, const std::vector<Override> &overrides)
  {
    Parameters parameters;
    dealii::ParameterHandler prm;
    parameters.file  = file;
    parameters.tools = tools_of(parameters.file);
    parameters.declare(prm);
    parameters.scene_name = parameters.file.name();
    parameters.file.parse(prm, overrides);

    std::ostringstream used;
    prm.print_parameters(used, dealii::ParameterHandler::PRM);
    parameters.as_used = used.str();

    check(parameters);
    return parameters;
  }
} // namespace Supple
