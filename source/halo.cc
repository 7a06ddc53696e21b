#include <supple/halo.h>

#include <cstring>

namespace Supple
{
  Halo::Halo(std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs)
    : n_owned(dofs->locally_owned_size() / 3)
    , n_local(n_owned + dofs->n_ghost_indices() / 3)
    , dofs(dofs)
  {
    for (const auto &[begin, end] : dofs->import_indices())
      for (unsigned int dof = begin; dof < end; ++dof)
        if (dof % 3 == 0)
          sent.push_back(dof / 3);
    buffer.resize(sent.size() * 4 * sizeof(float)); // enough for what is updated all the time
    requests.resize(dofs->import_targets().size() + dofs->ghost_targets().size());
  }


  void
  Halo::update(char *nodal, const std::size_t size) const
  {
    if (single() || size == 0)
      return;
    if (buffer.size() < sent.size() * size)
      buffer.resize(sent.size() * size);
    for (std::size_t k = 0; k < sent.size(); ++k)
      std::memcpy(&buffer[k * size], nodal + sent[k] * size, size);

    const int tag = 77;
    auto request  = requests.data();
    char *ghosts  = nodal + n_owned * size;
    for (const auto &[process, n_dofs] : dofs->ghost_targets())
      {
        const std::size_t n_bytes = n_dofs / 3 * size;
        MPI_Irecv(ghosts, n_bytes, MPI_BYTE, process, tag, communicator(), request++);
        ghosts += n_bytes;
      }
    const char *outgoing = buffer.data();
    for (const auto &[process, n_dofs] : dofs->import_targets())
      {
        const std::size_t n_bytes = n_dofs / 3 * size;
        MPI_Isend(outgoing, n_bytes, MPI_BYTE, process, tag, communicator(), request++);
        outgoing += n_bytes;
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
  }
} // namespace Supple
