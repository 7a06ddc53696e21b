#include <supple/scene/idle_entries.h>

namespace Supple
{
  namespace
  {
    /** Finds the entries of a scene that are set in vain, by comparing them with their defaults. */
    class Search
    {
    public:
      explicit Search(const Parameters &parameters)
        : scene(parameters)
      {
      }

      std::vector<std::string>
      all()
      {
        look_at_motions();
        look_at_loads();
        look_at_mesh();
        look_at_material();
        look_at_time();
        look_at_output();
        return found;
      }

    private:
      /** @param counts what must be so that the entry counts, as in "Motion/Of is not set" */
      template <typename Value>
      void
      note(const bool idle,
           const std::string &entry,
           const Value &value,
           const Value &preset,
           const std::string &reason)
      {
        if (idle && value != preset)
          found.push_back(scene.origin(entry) + ": it has no effect, for " + reason + ".");
      }

      static bool
      says_zero(const std::string &expressions)
      {
        return expressions.find_first_not_of("0.;+- ") == std::string::npos;
      }

      void
      look_at_motions()
      {
        for (unsigned int m = 0; m < scene.motions.size(); ++m)
          note(scene.motions[m].of.empty(),
               motion_section(m) + "/Displacement",
               scene.motions[m].displacement,
               defaults.motions[m].displacement,
               motion_section(m) + "/Of, which says what moves, is empty");
        note(scene.start.rotation.norm() == 0.,
             "Start/Rotation center",
             scene.start.rotation_center,
             defaults.start.rotation_center,
             "Start/Rotation is 0");
      }

      void
      look_at_loads()
      {
        const LoadParameters &loads = scene.loads, &preset = defaults.loads;
        const bool no_pressure = says_zero(loads.pressure);
        note(says_zero(loads.traction),
             "Loads/Traction on",
             loads.traction_on,
             preset.traction_on,
             "Loads/Traction is 0");
        note(no_pressure,
             "Loads/Pressure on",
             loads.pressure_on,
             preset.pressure_on,
             "Loads/Pressure is 0");
        note(no_pressure,
             "Loads/Pressure follows",
             loads.pressure_follows,
             preset.pressure_follows,
             "Loads/Pressure is 0");
        note(says_zero(loads.nodal_force),
             "Loads/Nodal force on",
             loads.nodal_force_on,
             preset.nodal_force_on,
             "Loads/Nodal force is 0");
      }

      void
      look_at_mesh()
      {
        using Shape                = MeshParameters::Shape;
        const MeshParameters &mesh = scene.mesh, &preset = defaults.mesh;
        const auto of = [&](const Shape shape,
                            const std::string &name,
                            const std::string &entry,
                            const auto &value,
                            const auto &preset_value) {
          note(
            mesh.shape != shape, "Mesh/" + entry, value, preset_value, "Mesh/Shape is not " + name);
        };
        of(Shape::file, "file", "File", mesh.file, preset.file);
        of(Shape::box, "box", "Box size", mesh.size, preset.size);
        of(Shape::box, "box", "Box cubes", mesh.cubes, preset.cubes);
        of(Shape::rectangle,
           "rectangle",
           "Rectangle size",
           mesh.rectangle_size,
           preset.rectangle_size);
        of(Shape::rectangle, "rectangle", "Rectangle squares", mesh.squares, preset.squares);
        const std::string cylinder = "hollow cylinder";
        of(Shape::hollow_cylinder,
           cylinder,
           "Cylinder inner radius",
           mesh.inner_radius,
           preset.inner_radius);
        of(Shape::hollow_cylinder,
           cylinder,
           "Cylinder outer radius",
           mesh.outer_radius,
           preset.outer_radius);
      }

      void
      look_at_material()
      {
        using Constants                    = MaterialParameters::Constants;
        const MaterialParameters &material = scene.material, &preset = defaults.material;
        const bool lame          = material.constants == Constants::lame;
        const std::string reason = std::string("Material/Elastic constants are ") +
                                   (lame ? "Lame's" : "Young's modulus and Poisson's ratio");
        note(lame, "Material/Young modulus", material.young, preset.young, reason);
        note(lame, "Material/Poisson ratio", material.poisson, preset.poisson, reason);
        note(!lame, "Material/Lame lambda", material.lambda, preset.lambda, reason);
        note(!lame, "Material/Lame mu", material.mu, preset.mu, reason);
      }

      void
      look_at_time()
      {
        const TimeParameters &time = scene.time, &preset = defaults.time;
        const bool fixed         = !time.has_variable_steps();
        const std::string reason = "Time/Variable steps is false";
        note(fixed, "Time/Longest step", time.longest_step, preset.longest_step, reason);
        note(fixed,
             "Time/Displacement tolerance",
             time.displacement_tolerance,
             preset.displacement_tolerance,
             reason);
        note(fixed,
             "Time/Velocity tolerance",
             time.velocity_tolerance,
             preset.velocity_tolerance,
             reason);
        note(scene.corotation.rotation == RotationMethod::none,
             "Corotation/Warp tolerance",
             scene.corotation.warp_tolerance,
             defaults.corotation.warp_tolerance,
             "Corotation/Rotation is none");
      }

      void
      look_at_output()
      {
        using Frames                   = OutputParameters::Frames;
        const OutputParameters &output = scene.output, &preset = defaults.output;
        note(output.frames == Frames::none &&
               scene.space.estimate == SpaceParameters::Estimate::frames,
             "Space/Estimate error",
             scene.space.estimate,
             defaults.space.estimate,
             "Output/Frames is none; the error in space is told at the end alone");
        if (output.frames == Frames::none)
          return; // all of them are silent on purpose
        note(output.frames != Frames::every,
             "Output/Every",
             output.every,
             preset.every,
             "Output/Frames is not every");
        note(output.frames != Frames::interval,
             "Output/Interval",
             output.interval,
             preset.interval,
             "Output/Frames is not interval");
        const bool no_profiles = scene.probes.profiles.empty();
        note(no_profiles,
             "Probes/Profile every",
             scene.probes.profile_every,
             defaults.probes.profile_every,
             "Probes/Profiles names none");
        note(no_profiles,
             "Probes/Profile center",
             scene.probes.profile_center,
             defaults.probes.profile_center,
             "Probes/Profiles names none");
      }

      const Parameters &scene;
      const Parameters defaults;
      std::vector<std::string> found;
    };
  } // namespace


  std::vector<std::string>
  idle_entries(const Parameters &parameters)
  {
    return Search(parameters).all();
  }
} // namespace Supple
