#ifndef supple_results_h
#define supple_results_h

#include <supple/base/folder_lock.h>
#include <supple/run/problem.h>
#include <supple/run/summary.h>
#include <supple/run/writers.h>
#include <supple/scene/parameters.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** The folder of a run with its writers, and what is written into it at the end. */
  class Results
  {
  public:
    /** @param folder if empty, nothing is written */
    Results(const std::string &folder, const Parameters &parameters, MPI_Comm communicator);

    /**
     * Adds a kind of writer, whose files are removed when a run begins anew.
     * @param wanted    whether the run has such a writer
     * @param arguments of its constructor after the folder
     * @return the writer, or null
     */
    template <class Kind, class... Arguments>
    Kind *
    add(const bool wanted, Arguments &&...arguments)
    {
      for (const std::string &pattern : Kind::files())
        own_files.push_back(pattern);
      if (!wanted)
        return nullptr;
      auto writer       = std::make_unique<Kind>(folder, std::forward<Arguments>(arguments)...);
      Kind *const added = writer.get();
      writers.push_back(std::move(writer));
      return added;
    }

    /** Keeps other runs out of the folder, if it is there; collective. @throws InputError on all
     * processes if another run is in it */
    void
    lock_folder();

    /**
     * Makes the folder ready, and locks it; collective.
     * @param resumed whether the files of an earlier run are gone on with, after @p step
     * @throws InputError on all processes if that can't be done
     */
    void
    open(bool resumed, unsigned int step);

    /** Writes summary.json, and the report if one is wanted. @param film of the report, or null
     * @throws WriteError on the first process */
    void
    write_end(const Summary &summary, const Film *film, const Problem &problem) const;

    /** The file of the report; empty if none is wanted. */
    std::string
    report_file() const;

    /** A sentence; empty where nothing is written. @param which results: "so far" */
    std::string
    whereabouts(const std::string &which) const;

    const std::string folder;
    const bool writes; ///< anything
    const bool writes_history;
    const bool writes_frames;

  private:
    const Parameters &parameters;
    const MPI_Comm communicator;
    const bool writes_report;
    std::vector<std::string> own_files;
    std::vector<std::unique_ptr<Writer>> writers;
    std::unique_ptr<const FolderLock> lock; ///< on the first process, once the folder is there
  };
} // namespace Supple

#endif
