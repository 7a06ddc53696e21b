#include <supple/forces/forces.h>

#include <supple/forces/contact.h>
#include <supple/forces/dead_loads.h>
#include <supple/forces/gravity.h>
#include <supple/forces/pressure.h>
#include <supple/forces/pulls.h>
#include <supple/mechanics/laws.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    using Maker = std::unique_ptr<Force> (*)(const Body &,
                                             const LoadParameters &,
                                             const ParameterFile &);

    /** Of each kind of load that a scene can have; null where it has none. */
    constexpr Maker load_makers[] = {DeadLoads::make, make_pressure, Gravity::make, Pulls::make};

    bool
    is_dead_load(const Force &force)
    {
      return force.is_load() && force.is_linear() && !force.has_tangent();
    }


    /** A load that is linear in the displacement: its part without is dead. */
    bool
    is_spring(const Force &force)
    {
      return force.is_load() && force.is_linear() && force.has_tangent();
    }
  } // namespace


  Forces::Forces(const Body &body,
                 const MaterialParameters &material,
                 const CorotationParameters &corotation,
                 const DampingParameters &damping,
                 const LoadParameters &loads,
                 const ContactParameters &contact,
                 const std::vector<ToolParameters> &tools,
                 const ParameterFile &scene)
    : body(body)
  {
    auto elastic = std::make_unique<ElasticForce>(body,
                                                  make_law(material.law_choice(),
                                                           corotation.rotation,
                                                           *body.cells),
                                                  damping.stiffness_factor);
    of_cells     = elastic.get();
    list.push_back(std::move(elastic));
    for (const Maker &make : load_makers)
      if (std::unique_ptr<Force> load = make(body, loads, scene))
        add(std::move(load));
    if (!tools.empty() || contact.between_bodies())
      {
        auto of_all = std::make_unique<Contact>(body, contact, tools, scene);
        of_contact  = of_all.get();
        add(std::move(of_all));
      }
  }


  Forces::~Forces() = default;


  void
  Forces::add(std::unique_ptr<Force> force)
  {
    if (force->is_load() && loads.size() == 0)
      body.initialize(loads);
    list.push_back(std::move(force));
  }


  bool
  Forces::any(const Condition &condition) const
  {
    return std::any_of(list.begin(), list.end(), [&](const auto &force) {
      return condition(*force);
    });
  }


  bool
  Forces::are_linear() const
  {
    return !any([](const Force &force) { return !force.is_linear(); });
  }


  bool
  Forces::others_than_contact_are_linear() const
  {
    return !any([this](const Force &force) { return &force != of_contact && !force.is_linear(); });
  }


  bool
  Forces::change_operator() const
  {
    return others_change_operator() || !of_cells->is_linear();
  }


  bool
  Forces::others_change_operator() const
  {
    return any([this](const Force &force) {
      return &force != of_cells && force.has_tangent() && !force.is_linear();
    });
  }


  bool
  Forces::others_have_tangent() const
  {
    return any([this](const Force &force) { return &force != of_cells && force.has_tangent(); });
  }


  bool
  Forces::loads_follow() const
  {
    return any([](const Force &force) { return force.is_load() && !force.is_linear(); });
  }


  bool
  Forces::have_energy() const
  {
    return !any([](const Force &force) { return !force.is_load() && !force.has_energy(); });
  }


  bool
  Forces::do_work() const
  {
    return any([](const Force &force) { return force.account() == EnergyAccount::work; });
  }


  void
  Forces::sum(Vector &f,
              const Configuration &configuration,
              const double time,
              const Condition &condition) const
  {
    sum_into(f, [&](double *sum) {
      for (const auto &force : list)
        if (condition(*force))
          force->add_force(configuration, time, sum);
    });
  }


  void
  Forces::set_loads(Vector &f, const Configuration &configuration, const double time) const
  {
    sum(f, configuration, time, [](const Force &force) { return force.is_load(); });
  }


  bool
  Forces::have_dead_loads() const
  {
    return any([](const Force &force) { return is_dead_load(force) || is_spring(force); });
  }


  void
  Forces::set_dead_loads(Vector &f, const Configuration &configuration, const double time) const
  {
    sum_into(f, [&](double *sum) {
      for (const auto &force : list)
        if (is_dead_load(*force))
          force->add_force(configuration, time, sum);
        else if (is_spring(*force))
          force->add_constant_part(time, 1., sum);
    });
  }


  void
  Forces::set_other_forces(Vector &f,
                           const Configuration &configuration,
                           const double time,
                           Effort &effort) const
  {
    const PhaseTimer timer(effort, Phase::forces);
    sum_into(f, [&](double *sum) {
      for (const auto &force : list)
        {
          if (!is_dead_load(*force))
            force->add_force(configuration, time, sum);
          if (is_spring(*force))
            force->add_constant_part(time, -1., sum);
        }
    });
  }


  void
  Forces::set_working(Vector &f, const Configuration &configuration, const double time) const
  {
    sum(f, configuration, time, [](const Force &force) {
      return force.account() == EnergyAccount::work;
    });
  }


  void
  Forces::set_force(Vector &f,
                    const Configuration &configuration,
                    const double time,
                    Effort &effort,
                    const double load_factor) const
  {
    const PhaseTimer timer(effort, Phase::forces);
    sum(f, configuration, time, [](const Force &force) { return !force.is_load(); });
    if (loads.size() > 0)
      {
        set_loads(loads, configuration, time);
        f.add(load_factor, loads);
      }
  }


  Energies
  Forces::energies(const Configuration &configuration,
                   const double time,
                   const double load_factor,
                   Deformation &deformation) const
  {
    deformation                = of_cells->deformation(configuration);
    std::vector<double> energy = {deformation.elastic, 0., 0.}; // elastic, potential, contact
    for (const auto &force : list)
      {
        const EnergyAccount account = force->account();
        const bool is_elastic       = account == EnergyAccount::elastic;
        const bool is_contact       = account == EnergyAccount::contact;
        if (force.get() != of_cells &&
            (is_elastic || is_contact || account == EnergyAccount::potential))
          energy[is_elastic   ? 0
                 : is_contact ? 2
                              : 1] +=
            (force->is_load() ? load_factor : 1.) * force->energy(configuration, time);
      }
    std::vector<double> all(energy.size());
    Utilities::MPI::sum(energy, body.mesh.communicator, all);
    return {all[0], all[1], all[2]};
  }


  double
  Forces::energy(const Configuration &configuration,
                 const double time,
                 const double load_factor) const
  {
    double energy = 0.;
    for (const auto &force : list)
      energy += (force->is_load() ? load_factor : 1.) * force->energy(configuration, time);
    return Utilities::MPI::sum(energy, body.mesh.communicator);
  }


  double
  Forces::work_along(const Configuration &configuration,
                     const double time,
                     const Vector &from) const
  {
    double work = 0.;
    for (const auto &force : list)
      work += force->work_along(configuration, time, from);
    return Utilities::MPI::sum(work, body.mesh.communicator);
  }


  double
  Forces::work_of_time(const Configuration &configuration,
                       const double time_before,
                       const double time,
                       const double weight) const
  {
    double work = 0.;
    for (const auto &force : list)
      work += force->work_of_time(configuration, time_before, time, weight);
    return Utilities::MPI::sum(work, body.mesh.communicator);
  }


  double
  Forces::dissipated(const Configuration &configuration, const double time) const
  {
    double energy = 0.;
    for (const auto &force : list)
      energy += force->dissipated(configuration, time);
    return Utilities::MPI::sum(energy, body.mesh.communicator);
  }


  double
  Forces::largest_step(const Configuration &configuration, const Vector &correction) const
  {
    double part = 1.;
    for (const auto &force : list)
      part = std::min(part, force->largest_step(configuration, correction));
    return part;
  }


  Couplings
  Forces::couplings() const
  {
    Couplings pairs;
    for (const auto &force : list)
      force->add_couplings(pairs);
    return pairs;
  }


  bool
  Forces::couplings_come_and_go() const
  {
    return any([](const Force &force) { return force.couplings_come_and_go(); });
  }


  bool
  Forces::couplings_have_changed() const
  {
    return any([](const Force &force) { return force.couplings_have_changed(); });
  }


  void
  Forces::connect(const SymmetricPattern &pattern)
  {
    for (const auto &force : list)
      force->connect(pattern);
  }


  void
  Forces::update_tangent(const Tangent tangent,
                         const Configuration &configuration,
                         const double time,
                         Effort &effort,
                         const double load_factor)
  {
    const PhaseTimer timer(effort, Phase::assembly);
    for (const auto &force : list)
      force->update_tangent(tangent, configuration, time, force->is_load() ? load_factor : 1.);
  }


  void
  Forces::add_product(const Configuration &configuration,
                      const TangentFactors &factors,
                      const double *w,
                      double *y) const
  {
    for (const auto &force : list)
      force->add_product(configuration, factors, w, y);
  }


  void
  Forces::add_tangent(const Configuration &configuration,
                      const TangentFactors &factors,
                      SymmetricBlockMatrix &A,
                      const double added_bulk) const
  {
    for (const auto &force : list)
      if (force.get() == of_cells)
        of_cells->add_bounded_tangent(configuration, factors, A, added_bulk);
      else
        force->add_tangent(configuration, factors, A);
  }


  double
  Forces::round_off(const Configuration &configuration) const
  {
    double square = configuration.patches ? configuration.patches->round_off_square() : 0.;
    for (const auto &force : list)
      square += force->round_off_square();
    return std::sqrt(Utilities::MPI::sum(square, body.mesh.communicator));
  }
} // namespace Supple
