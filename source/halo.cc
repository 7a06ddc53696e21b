#include <supple/halo.h>

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

    const int tag = 77;
    auto request  = requests.data();
    char *ghosts  = nodal + n_owned * size;
    for (const auto &[process, n_indices] : indices->ghost_targets())
      {
        const std::size_t n_bytes = n_indices / n_per_node * size;
        MPI_Irecv(ghosts, n_bytes, MPI_BYTE, process, tag, communicator(), request++);
        ghosts += n_bytes;
      }
    const char *outgoing = buffer.data();
    for (const auto &[process, n_indices] : indices->import_targets())
      {
        const std::size_t n_bytes = n_indices / n_per_node * size;
        MPI_Isend(outgoing, n_bytes, MPI_BYTE, process, tag, communicator(), request++);
        outgoing += n_bytes;
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
  }


  void
  Halo::fetch_ghosts(const char *nodal, const std::size_t size) const
  {
    const int tag  = 78;
    auto request   = requests.data();
    char *incoming = buffer.data();
    for (const auto &[process, n_indices] : indices->import_targets())
      {
        const std::size_t n_bytes = n_indices / n_per_node * size;
        MPI_Irecv(incoming, n_bytes, MPI_BYTE, process, tag, communicator(), request++);
        incoming += n_bytes;
      }
    const char *ghosts = nodal + n_owned * size;
    for (const auto &[process, n_indices] : indices->ghost_targets())
      {
        const std::size_t n_bytes = n_indices / n_per_node * size;
        MPI_Isend(ghosts, n_bytes, MPI_BYTE, process, tag, communicator(), request++);
        ghosts += n_bytes;
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
  }
} // namespace Supple
