#include <supple/forces/pulls.h>

#include <map>

namespace Supple
{
  using dealii::Tensor;

  std::unique_ptr<Force>
  Pulls::make(const Body &body, const LoadParameters &parameters, const ParameterFile &)
  {
    if (parameters.pulls.empty())
      return nullptr;
    return std::make_unique<Pulls>(body, parameters.pulls);
  }


  Pulls::Pulls(const Body &body, const std::vector<Pull> &pulls)
  {
    std::map<unsigned int, unsigned int> own_nodes; // by the index in the mesh
    for (unsigned int node = 0; node < body.n_owned; ++node)
      own_nodes.emplace(body.serial_vertex[node], node);
    for (const Pull &pull : pulls)
      for (const Pull::End &end : pull.ends)
        if (const auto found = own_nodes.find(end.vertex); found != own_nodes.end())
          springs.push_back({found->second,
                             end.stiffness,
                             end.offset - Tensor<1, 3>(body.position(found->second)),
                             pull.path});
  }


  Tensor<1, 3>
  Pulls::length(const Spring &spring, const Vector &displacement, const double time)
  {
    Tensor<1, 3> length = spring.path->at(time) + spring.offset;
    for (unsigned int i = 0; i < 3; ++i)
      length[i] -= displacement.local_element(3 * spring.node + i);
    return length;
  }


  void
  Pulls::add_force(const Configuration &configuration, const double time, double *f) const
  {
    for (const Spring &spring : springs)
      {
        const Tensor<1, 3> way = length(spring, configuration.displacement(), time);
        for (unsigned int i = 0; i < 3; ++i)
          f[3 * spring.node + i] += spring.stiffness * way[i];
      }
  }


  void
  Pulls::add_constant_part(const double time, const double part, double *f) const
  {
    for (const Spring &spring : springs)
      {
        const Tensor<1, 3> way = spring.path->at(time) + spring.offset;
        for (unsigned int i = 0; i < 3; ++i)
          f[3 * spring.node + i] += part * spring.stiffness * way[i];
      }
  }


  double
  Pulls::energy(const Configuration &configuration, const double time) const
  {
    double sum = 0.;
    for (const Spring &spring : springs)
      sum +=
        0.5 * spring.stiffness * length(spring, configuration.displacement(), time).norm_square();
    return sum;
  }


  void
  Pulls::add_product(const Configuration &,
                     const TangentFactors &factors,
                     const double *w,
                     double *y) const
  {
    for (const Spring &spring : springs)
      for (unsigned int i = 0; i < 3; ++i)
        y[3 * spring.node + i] += factors.displacement * spring.stiffness * w[3 * spring.node + i];
  }


  void
  Pulls::add_tangent(const Configuration &,
                     const TangentFactors &factors,
                     SymmetricBlockMatrix &A) const
  {
    for (const Spring &spring : springs)
      for (unsigned int i = 0; i < 3; ++i)
        A.diagonal[9 * static_cast<std::size_t>(spring.node) + 4 * i] +=
          factors.displacement * spring.stiffness;
  }
} // namespace Supple
