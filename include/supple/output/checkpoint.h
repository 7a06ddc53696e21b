#ifndef supple_checkpoint_h
#define supple_checkpoint_h

#include <supple/mechanics/body.h>
#include <supple/output/output_parameters.h>

#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace Supple
{
  /**
   * A file in the output folder from which a run goes on: checkpoint.cbor, and the one before it,
   * checkpoint.previous.cbor. It holds displacement and velocity by the vertices of the mesh before
   * partitioning, so that the number of processes may change, and what the other rooms keep. Each
   * is written aside and renamed: at any moment there is one that is whole.
   */
  class Checkpoint
  {
  public:
    /**
     * @param scene   each entry with its value, as the text of a scene file: a run goes on from a
     *                checkpoint of the same scene alone
     * @param dynamic more steps are the same scene
     * @param folder  of the results
     */
    Checkpoint(const Body &body,
               const CheckpointParameters &wanted,
               const std::string &scene,
               bool dynamic,
               const std::string &folder);

    /** The step of the checkpoint that a run in this folder would go on from; nothing without one.
     * Collective. @throws InputError on all processes if it is of another version */
    static std::optional<unsigned int>
    step_in(const std::string &folder, MPI_Comm communicator);

    /** Their names in the folder. */
    static std::vector<std::string>
    files();

    /** Whether steps or time since the last one are enough. The same answer on all processes. */
    bool
    due(unsigned int step) const;

    /**
     * The results that a run would go on with are on the disk before it is; after it if the run is
     * to end at once, for a loss of power is rarer than a second signal then.
     * @param rest what the other rooms keep; counts on the first process
     * @throws WriteError
     */
    void
    write(unsigned int step,
          const std::vector<const Vector *> &vectors,
          const nlohmann::json &rest,
          bool in_haste);

    /**
     * The rest, and the vectors set, if there is a file. Of the vectors those at the end that it
     * has not are left as they are.
     * @param n_needed of the vectors, which must be there
     * @throws InputError if it is damaged (and so is the one before it), of another scene or of
     * other content
     */
    std::optional<nlohmann::json>
    read(const std::vector<Vector *> &vectors, unsigned int n_needed);

    /** @throws InputError that the file which was read has other content than a checkpoint */
    [[noreturn]] void
    refuse_content() const;

    /** "step 20 of checkpoint.cbor", and of a damaged file before it; empty if none was read. */
    const std::string &
    origin() const
    {
      return read_in_words;
    }

    /** Whether checkpoint.cbor was damaged, so that the one before it was read. */
    bool
    was_damaged() const
    {
      return damaged;
    }

  private:
    /** What must be the same for a run to go on: parameters but for output, and the mesh. */
    std::string
    identity() const;

    void
    sync_results();

    /** Of the first file that is whole; empty if there is none. On the first process. */
    std::string
    read_content();

    /** Sets the vectors from what the file says; gives the rest. */
    nlohmann::json
    unpack(const nlohmann::json &all, const std::vector<Vector *> &vectors, unsigned int n_needed);

    const Body &body;
    const CheckpointParameters &wanted;
    const std::string scene;
    const bool dynamic;
    const std::string file, previous_file;
    std::string read_in_words;
    bool damaged           = false;
    unsigned int last_step = 0; ///< with a checkpoint
    std::chrono::steady_clock::time_point last_time;
    std::filesystem::file_time_type synced = std::filesystem::file_time_type::min();
  };
} // namespace Supple

#endif
