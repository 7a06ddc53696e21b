#include <supple/linear_algebra/halo.h>

#include <cstring>

namespace Supple
{
  Halo::Halo(std::shared_ptr<const dealii::Utilities::MPI::Partitioner> indices,
             const unsigned int n_per_node)
    : n_owned(indices->locally_owned_size() / n_per_node)
    , n_local(n_owned + indices->n_ghost_indices() / n_per_node)
    , indices(indices)
    , n_per_node(n_per_node)
  {
    for (const auto &[begin, end] : indices->import_indices())
      for (unsigned int index = begin; index < end; ++index)
        if (index % n_per_node == 0)
          shared.push_back(index / n_per_node);
    buffer.resize(shared.size() * 8 * sizeof(float)); // enough for what is updated all the time
    requests.resize(indices->import_targets().size() + indices->ghost_targets().size());
  }


  void
  Halo::update(char *nodal, const std::size_t size) const
  {
    if (single() || size == 0)
      return;
    if (buffer.size() < shared.size() * size)
      buffer.resize(shared.size() * size);
    for (std::size_t k = 0; k < shared.size(); ++k)
      std::memcpy(&buffer[k * size], nodal + shared[k] * size, size);

    exchange(indices->ghost_targets(),
             nodal + n_owned * size,
             indices->import_targets(),
             buffer.data(),
             size);
  }


  void
  Halo::fetch_ghosts(const char *nodal, const std::size_t size) const
  {
    if (buffer.size() < shared.size() * size)
      buffer.resize(shared.size() * size);
    exchange(indices->import_targets(),
             buffer.data(),
             indices->ghost_targets(),
             nodal + n_owned * size,
             size);
  }


  void
  Halo::exchange(const Targets &senders,
                 char *incoming,
                 const Targets &receivers,
                 const char *outgoing,
                 const std::size_t size) const
  {
    const int tag = 77;
    auto request  = requests.data();
    for (const auto &[process, n_indices] : senders)
      {
        const std::size_t n_bytes = n_indices / n_per_node * size;
        MPI_Irecv(incoming, n_bytes, MPI_BYTE, process, tag, communicator(), request++);
        incoming += n_bytes;
      }
    for (const auto &[process, n_indices] : receivers)
      {
        const std::size_t n_bytes = n_indices / n_per_node * size;
        MPI_Isend(outgoing, n_bytes, MPI_BYTE, process, tag, communicator(), request++);
        outgoing += n_bytes;
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
  }
} // namespace Supple
