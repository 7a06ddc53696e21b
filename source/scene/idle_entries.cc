#include <supple/scene/idle_entries.h>

#include <supple/base/expression.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace Supple
{
  namespace
  {
    /** Entries that count for nothing while a condition holds. */
    struct Rule
    {
      bool holds;
      std::string reason; ///< "Mesh/Shape is not box."
      std::vector<std::string> entries;
    };


    bool
    says_zero(const std::string &expressions)
    {
      const auto components = dealii::Utilities::split_string_list(expressions, ';');
      return std::all_of(components.begin(), components.end(), Expression::says_zero);
    }


    std::vector<Rule>
    rules_of_mesh(const MeshParameters &mesh, const SpaceParameters &space)
    {
      using Shape                            = MeshParameters::Shape;
      const RefinementParameters &refinement = mesh.refinement;
      return {
        {mesh.shape != Shape::file, "Mesh/Shape is not file.", {"Mesh/File", "Mesh/Scale"}},
        {mesh.shape != Shape::box,
         "Mesh/Shape is not box.",
         {"Mesh/Box size", "Mesh/Box cubes", "Mesh/Box origin"}},
        {mesh.shape != Shape::rectangle,
         "Mesh/Shape is not rectangle.",
         {"Mesh/Rectangle size",
          "Mesh/Rectangle squares",
          "Mesh/Rectangle origin",
          "Mesh/Rectangle split"}},
        {mesh.shape != Shape::hollow_cylinder,
         "Mesh/Shape is not hollow cylinder.",
         {"Mesh/Cylinder inner radius",
          "Mesh/Cylinder outer radius",
          "Mesh/Cylinder height",
          "Mesh/Cylinder sectors",
          "Mesh/Cylinder rings",
          "Mesh/Cylinder layers"}},
        {refinement.region.empty(),
         "Mesh/Refine region is empty.",
         {"Mesh/Refine region times", "Mesh/Refine region size"}},
        {!refinement.region.empty() && refinement.region_size > 0.,
         "Mesh/Refine region size says how far cells are cut.",
         {"Mesh/Refine region times"}},
        {refinement.region.empty() && refinement.by.empty() && space.aim == 0.,
         "nothing is refined.",
         {"Mesh/Refine most cells"}},
      };
    }


    std::vector<Rule>
    rules_of_loads(const LoadParameters &loads, const StartParameters &start)
    {
      return {
        {says_zero(loads.traction), "Loads/Traction is 0.", {"Loads/Traction on"}},
        {says_zero(loads.pressure),
         "Loads/Pressure is 0.",
         {"Loads/Pressure on", "Loads/Pressure follows"}},
        {says_zero(loads.nodal_force), "Loads/Nodal force is 0.", {"Loads/Nodal force on"}},
        {start.rotation.norm() == 0., "Start/Rotation is 0.", {"Start/Rotation center"}},
      };
    }


    std::vector<Rule>
    rules_of_material(const Parameters &scene)
    {
      using Constants = MaterialParameters::Constants;
      const bool lame = scene.material.constants == Constants::lame;
      return {
        {lame,
         "Material/Elastic constants are Lame's.",
         {"Material/Young modulus", "Material/Poisson ratio"}},
        {!lame,
         "Material/Elastic constants are Young's modulus and Poisson's ratio.",
         {"Material/Lame lambda", "Material/Lame mu"}},
        {scene.material.law != "mooney-rivlin",
         "Material/Law is not mooney-rivlin.",
         {"Material/Mooney ratio"}},
        {scene.corotation.rotation == RotationMethod::none,
         "Corotation/Rotation is none.",
         {"Corotation/Warp tolerance"}},
      };
    }


    std::vector<Rule>
    rules_of_time(const TimeParameters &time)
    {
      const std::vector<std::string> tolerances = {"Time/Relative tolerance",
                                                   "Time/Displacement tolerance",
                                                   "Time/Velocity tolerance",
                                                   "Time/Longest step"};
      if (time.problem == TimeParameters::Problem::stationary)
        return {{true,
                 "Time/Problem is static.",
                 {"Time/Step", "Time/Method", "Time/Energy guard"}},
                {true, "Time/Problem is static.", tolerances}};
      return {
        {!time.has_variable_steps(), "Time/Variable steps is false.", tolerances},
        {time.method != TimeMethod::ida, "Time/Method is not ida.", {"Time/Maximum order"}},
        {!time.is_semi_implicit(),
         "Time/Method is none of imex3 to imex5.",
         {"Time/Renewal angle"}},
        {time.is_semi_implicit(),
         "Time/Method = " + time.method_name() + " has no Newton iterations.",
         {"Time/Newton tolerance", "Time/Newton iterations", "Time/Tangent"}},
      };
    }


    std::vector<Rule>
    rules_of_output(const OutputParameters &output,
                    const SpaceParameters &space,
                    const ProbeParameters &probes)
    {
      using Frames = OutputParameters::Frames;
      // Without frames all entries about them are silent on purpose.
      const bool frames = output.frames != Frames::none;
      return {
        {frames && output.frames != Frames::every, "Output/Frames is not every.", {"Output/Every"}},
        {frames && output.frames != Frames::interval,
         "Output/Frames is not interval.",
         {"Output/Interval"}},
        {frames && output.frames != Frames::adaptive,
         "Output/Frames is not adaptive.",
         {"Output/Motion", "Output/Volume ratio change", "Output/Longest interval"}},
        {!frames && space.estimate == SpaceParameters::Estimate::frames,
         "Output/Frames is none: the error in space is told at the end alone.",
         {"Space/Estimate error"}},
        {probes.profiles.empty(),
         "Probes/Profiles names none.",
         {"Probes/Profile every", "Probes/Profile center"}},
      };
    }


    std::vector<Rule>
    rules_of_contact(const Parameters &scene)
    {
      using Shape             = ToolParameters::Shape;
      std::vector<Rule> rules = {
        {!scene.has_contact(),
         "there is no subsection Tool, and Contact/Bodies is tools.",
         {"Contact/Stiffness", "Contact/Reach", "Contact/Guard", "Contact/Slip resolution"}},
        {!scene.contact.between_bodies(), "Contact/Bodies is tools.", {"Contact/Friction"}},
        {std::all_of(scene.tools.begin(),
                     scene.tools.end(),
                     [](const ToolParameters &tool) { return tool.friction == 0.; }) &&
           !(scene.contact.between_bodies() && scene.contact.friction > 0.),
         "nothing has friction.",
         {"Contact/Slip resolution"}}};
      for (const ToolParameters &tool : scene.tools)
        {
          const std::string name = tool.section();
          rules.push_back(
            {tool.shape != Shape::plane, name + "/Shape is not plane.", {name + "/Normal"}});
          rules.push_back(
            {tool.shape != Shape::capsule, name + "/Shape is not capsule.", {name + "/Axis"}});
          rules.push_back({tool.shape != Shape::sphere && tool.shape != Shape::capsule,
                           name + "/Shape is neither sphere nor capsule.",
                           {name + "/Radius"}});
          rules.push_back(
            {tool.shape != Shape::box, name + "/Shape is not box.", {name + "/Size"}});
          rules.push_back({tool.shape != Shape::file,
                           name + "/Shape is not file.",
                           {name + "/File", name + "/Scale"}});
        }
      return rules;
    }


    std::vector<Rule>
    all_rules(const Parameters &scene)
    {
      std::vector<Rule> rules;
      for (unsigned int m = 0; m < scene.motions.size(); ++m)
        rules.push_back({scene.motions[m].of.empty(),
                         motion_section(m) + "/Of, which says what moves, is empty.",
                         {motion_section(m) + "/Displacement"}});
      for (const auto &more : {rules_of_mesh(scene.mesh, scene.space),
                               rules_of_loads(scene.loads, scene.start),
                               rules_of_material(scene),
                               rules_of_time(scene.time),
                               rules_of_contact(scene),
                               rules_of_output(scene.output, scene.space, scene.probes)})
        rules.insert(rules.end(), more.begin(), more.end());
      return rules;
    }
  } // namespace


  std::vector<std::string>
  idle_entries(const Parameters &scene)
  {
    std::vector<std::string> found;
    for (const Rule &rule : all_rules(scene))
      for (const std::string &entry : rule.entries)
        if (rule.holds && scene.changes(entry))
          found.push_back(scene.origin(entry) + ": it has no effect, for " + rule.reason);
    return found;
  }
} // namespace Supple
