#include <supple/multigrid/block_exchange.h>

#include <deal.II/base/mpi.h>

namespace Supple
{
  namespace
  {
    /** By deal.II's sparse exchange, in which nobody has to know who will send something. */
    BlockExchange::Entries
    exchange(const BlockExchange::Entries &sent, const MPI_Comm communicator)
    {
      std::map<unsigned int, std::vector<std::uint32_t>> outgoing;
      for (const auto &[process, entries] : sent)
        for (const BlockExchange::Entry &entry : entries)
          outgoing[process].insert(outgoing[process].end(), {entry.row, entry.column});
      BlockExchange::Entries received;
      for (const auto &[process, nodes] :
           dealii::Utilities::MPI::some_to_some(communicator, outgoing))
        for (std::size_t k = 0; k < nodes.size(); k += 2)
          received[process].push_back({nodes[k], nodes[k + 1]});
      return received;
    }


    void
    add(CoarseMatrix::Block &block, const CoarseMatrix::Block &part, const bool mirrored)
    {
      for (unsigned int i = 0; i < 6; ++i)
        if (mirrored)
          for (unsigned int j = 0; j < 6; ++j)
            block.row[i][j] += part.row[j][i];
        else
          block.row[i] += part.row[i];
    }
  } // namespace


  BlockExchange::BlockExchange(const Entries &sent, const MPI_Comm communicator)
    : received(exchange(sent, communicator))
    , communicator(communicator)
    , sent(sent)
  {
  }


  void
  BlockExchange::find_places(const CoarseLevel &level, const SymmetricPattern &between_ghosts)
  {
    const SymmetricPattern &pattern = level.matrix.pattern;
    const auto place_of             = [&](const Entry &entry) -> Place {
      const std::uint32_t i = level.numbers.local(entry.row);
      const std::uint32_t j = level.numbers.local(entry.column);
      if (i == j)
        return {i, true, false};
      const std::uint32_t row = std::max(i, j), column = std::min(i, j);
      const std::size_t index = column < pattern.n_owned
                                              ? pattern.position(row, column)
                                              : pattern.n_entries() + between_ghosts.position(row, column);
      return {static_cast<std::uint32_t>(index), false, i < j};
    };
    const auto find = [&](const Entries &entries, std::vector<Neighbor> &neighbors) {
      for (const auto &[process, list] : entries)
        {
          neighbors.push_back({process, {}});
          for (const Entry &entry : list)
            neighbors.back().places.push_back(place_of(entry));
        }
    };
    find(sent, targets);
    find(received, sources);
  }


  void
  BlockExchange::sum(CoarseMatrix &matrix) const
  {
    using Blocks  = std::vector<CoarseMatrix::Block>;
    const int tag = 79;
    std::vector<MPI_Request> requests(sources.size() + targets.size());
    std::vector<Blocks> parts(requests.size());
    const auto block_at = [&](const Place &place) -> CoarseMatrix::Block & {
      return (place.diagonal ? matrix.diagonal : matrix.lower)[place.index];
    };
    const auto n_bytes = [](const Blocks &blocks) {
      return static_cast<int>(blocks.size() * sizeof(CoarseMatrix::Block));
    };

    std::size_t n = 0;
    for (const Neighbor &source : sources)
      {
        Blocks &part = parts[n];
        part.resize(source.places.size());
        MPI_Irecv(
          part.data(), n_bytes(part), MPI_BYTE, source.process, tag, communicator, &requests[n++]);
      }
    for (const Neighbor &target : targets)
      {
        Blocks &part = parts[n];
        for (const Place &place : target.places)
          part.push_back(block_at(place));
        MPI_Isend(
          part.data(), n_bytes(part), MPI_BYTE, target.process, tag, communicator, &requests[n++]);
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);

    for (std::size_t k = 0; k < sources.size(); ++k)
      for (std::size_t b = 0; b < parts[k].size(); ++b)
        {
          const Place &place = sources[k].places[b];
          add(block_at(place), parts[k][b], place.mirrored);
        }
  }
} // namespace Supple
