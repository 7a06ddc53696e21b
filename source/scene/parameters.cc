#include <supple/scene/parameters.h>

namespace Supple
{
  void
  Parameters::declare(dealii::ParameterHandler &prm)
  {
    mesh.declare(prm);
    plane.declare(prm);
    material.declare(prm);
    corotation.declare(prm);
    damping.declare(prm);
    constraints.declare(prm);
    for (unsigned int m = 0; m < motions.size(); ++m)
      motions[m].declare(prm, motion_section(m));
    loads.declare(prm);
    contact.declare(prm);
    for (ToolParameters &tool : tools)
      tool.declare(prm);
    start.declare(prm);
    time.declare(prm);
    solver.declare(prm);
    output.declare(prm);
    probes.declare(prm);
    space.declare(prm);
    checkpoint.declare(prm);
    live.declare(prm);
  }


  std::string
  Parameters::output_folder() const
  {
    return output.folder.empty() ? "output/" + scene_name : output.folder;
  }


  std::string
  Parameters::origin(const std::string &entry) const
  {
    return file.origin(entry);
  }


  bool
  Parameters::changes(const std::string &entry) const
  {
    return file.changes(entry);
  }
} // namespace Supple
