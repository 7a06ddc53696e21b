#ifndef supple_writers_h
#define supple_writers_h

#include <supple/base/csv_file.h>
#include <supple/base/effort.h>
#include <supple/contact/contact_parameters.h>
#include <supple/observe/probes.h>
#include <supple/observe/profiles.h>
#include <supple/output/frames.h>
#include <supple/run/listener.h>
#include <supple/run/second_mesh.h>
#include <supple/run/space_estimate.h>
#include <supple/run/step_doubling.h>

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <string>
#include <vector>

namespace Supple
{
  /** A listener that writes files into the folder of results. Each class of them has a function
   * files(), the patterns of their names as remove_files() takes them. */
  class Writer : public Listener
  {
  public:
    /**
     * Makes the files, or goes on with those of an earlier run. On the first process.
     * @param step that the run goes on from, 0 at the start
     * @throws WriteError, InputError if there is less than the checkpoint knows of
     */
    virtual void
    open(bool resumed, unsigned int step) = 0;

  protected:
    Writer(const std::string &folder, Effort &effort)
      : folder(folder)
      , effort(effort)
    {
    }

    const std::string folder;
    Effort &effort;
  };


  /** A table with a row for each state, the start included. */
  class StateTable : public Writer
  {
  public:
    void
    open(bool resumed, unsigned int step) override;

    bool
    after_step(const Observation &now) override;

  protected:
    /** @param name of the file */
    StateTable(const std::string &folder,
               Effort &effort,
               const std::string &name,
               const std::vector<std::string> &columns);

  private:
    virtual std::vector<double>
    row(const Observation &now) const = 0;

    const std::string file;
    const std::vector<std::string> columns;
    std::unique_ptr<CsvFile> table; ///< on the first process
  };


  /** history.csv: energies, momenta, volumes, iterations; and the error in space of the frames, if
   * that is asked for, empty where there is none. */
  class HistoryTable : public StateTable
  {
  public:
    /** @param with_contact whether there are tools
     * @param space that estimates the errors of the frames, or null */
    HistoryTable(const std::string &folder,
                 Effort &effort,
                 bool with_contact,
                 const SpaceEstimate *space);

    static std::vector<std::string>
    files();

  private:
    std::vector<double>
    row(const Observation &now) const override;

    const SpaceEstimate *const space;
  };


  /** What each tool meets: tool_NAME.csv. */
  class ToolTables : public Writer
  {
  public:
    ToolTables(const std::string &folder, Effort &effort, const std::vector<ToolParameters> &tools);

    static std::vector<std::string>
    columns();

    static std::vector<std::string>
    files();

    void
    open(bool resumed, unsigned int step) override;

    bool
    after_step(const Observation &now) override;

    /** Of a tool after a step. */
    static std::vector<double>
    row(const Measurement &now, const ToolReport &tool);

  private:
    const std::vector<ToolParameters> &tools;
    std::vector<std::unique_ptr<CsvFile>> tables; ///< on the first process
  };


  /** probes.csv */
  class ProbeTable : public StateTable
  {
  public:
    ProbeTable(const std::string &folder, Effort &effort, const Probes &probes);

    static std::vector<std::string>
    files();

  private:
    std::vector<double>
    row(const Observation &now) const override;
  };


  /** The shapes of boundaries at every so many steps and at the end: profile_NAME.csv has a row for
   * each vertex of the boundary. */
  class ProfileTables : public Writer
  {
  public:
    /** @param every how many steps */
    ProfileTables(const std::string &folder,
                  Effort &effort,
                  const Profiles &profiles,
                  unsigned int every);

    static std::vector<std::string>
    files();

    void
    open(bool resumed, unsigned int step) override;

    bool
    after_step(const Observation &now) override;

    void
    end(const Observation &now) override;

    std::string
    name() const override;

    nlohmann::json
    save() const override;

    void
    load(const nlohmann::json &saved) override;

  private:
    /** Writes the state, unless it was written already. @throws WriteError on the first process */
    void
    write(const Observation &now);

    struct Table
    {
      unsigned long n_rows = 0; ///< written; counts on the first process
      std::unique_ptr<CsvFile> file;
    };

    const Profiles &profiles;
    const unsigned int every;
    std::vector<Table> tables;
    bool written                   = false;
    unsigned int last_written_step = 0;
  };


  /** Frames for ParaView and the report when something has happened that should be seen, and at the
   * end. */
  class FrameWriter : public Writer
  {
  public:
    /** As Frames. */
    FrameWriter(const std::string &folder,
                Effort &effort,
                const Configuration &configuration,
                const Forces &forces,
                const OutputParameters &parameters,
                const CellErrors *errors,
                bool of_all_frames);

    static std::vector<std::string>
    files();

    void
    open(bool resumed, unsigned int step) override;

    /** Objects to a state that a frame is due for and can't hold. */
    std::string
    objection(const Observation &now) override;

    void
    begin(const Observation &now, bool resumed) override;

    bool
    after_step(const Observation &now) override;

    void
    end(const Observation &now) override;

    std::string
    name() const override;

    nlohmann::json
    save() const override;

    void
    load(const nlohmann::json &saved) override;

    Vector *
    kept_vector() override;

    const Frames &
    written() const
    {
      return frames;
    }

  private:
    Frames frames;
  };


  /** A row in error.csv where the error is known by a second run. */
  class ErrorTable : public Writer
  {
  public:
    ErrorTable(const std::string &folder,
               Effort &effort,
               const StepDoubling *second_run,
               const SecondMesh *second_mesh);

    static std::vector<std::string>
    files();

    void
    open(bool resumed, unsigned int step) override;

    void
    begin(const Observation &now, bool resumed) override;

    bool
    after_step(const Observation &now) override;

  private:
    const StepDoubling *const second_run; ///< or null
    const SecondMesh *const second_mesh;  ///< or null
    std::unique_ptr<CsvFile> table;       ///< on the first process
  };
} // namespace Supple

#endif
