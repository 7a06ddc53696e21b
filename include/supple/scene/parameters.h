#ifndef supple_parameters_h
#define supple_parameters_h

#include <supple/contact/contact_parameters.h>
#include <supple/forces/load_parameters.h>
#include <supple/mechanics/constraint_parameters.h>
#include <supple/mechanics/material_parameters.h>
#include <supple/mesh/mesh_parameters.h>
#include <supple/observe/probe_parameters.h>
#include <supple/observe/space_parameters.h>
#include <supple/output/output_parameters.h>
#include <supple/scene/live_parameters.h>
#include <supple/solvers/solver_parameters.h>
#include <supple/time/time_parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Everything that a scene file can say: the subsections of all rooms. See read_scene(). */
  struct Parameters
  {
    MeshParameters mesh;
    PlaneParameters plane;
    MaterialParameters material;
    CorotationParameters corotation;
    DampingParameters damping;
    ConstraintParameters constraints;
    Motions motions;
    LoadParameters loads;
    ContactParameters contact;
    std::vector<ToolParameters> tools;

    /** Whether anything touches anything. */
    bool
    has_contact() const
    {
      return !tools.empty() || contact.between_bodies();
    }

    StartParameters start;
    TimeParameters time;
    SolverParameters solver;
    OutputParameters output;
    ProbeParameters probes;
    SpaceParameters space;
    CheckpointParameters checkpoint;
    LiveParameters live;

    ParameterFile file;     ///< where each entry was set
    std::string scene_name; ///< of the file, without folder and ending
    std::string as_used;    ///< each entry with its value, as the text of a scene file

    void
    declare(dealii::ParameterHandler &prm);

    /** Where results go unless the command line says otherwise: output/ and the name of the scene.
     */
    std::string
    output_folder() const;

    /** Where an entry ("Section/Entry") got its value, and the value: to begin a message with. */
    std::string
    origin(const std::string &entry) const;

    /** Whether the scene gives an entry another value than it has by default. */
    bool
    changes(const std::string &entry) const;
  };
} // namespace Supple

#endif
