#ifndef supple_create_integrator_h
#define supple_create_integrator_h

#include <supple/time/time_integrator.h>

#include <memory>

namespace Supple
{
  /** The method that the scene asks for. The rotations of the configuration become those of its
   * displacement. */
  std::unique_ptr<TimeIntegrator>
  create_integrator(const Model &model);
} // namespace Supple

#endif
