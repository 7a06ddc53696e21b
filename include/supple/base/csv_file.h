#ifndef supple_csv_file_h
#define supple_csv_file_h

#include <fstream>
#include <string>
#include <vector>

namespace Supple
{
  /** A CSV file of numbers which is complete after every row. What is not a number is left empty.
   */
  class CsvFile
  {
  public:
    /** @throws WriteError if the file can't be written */
    CsvFile(const std::string &file, const std::vector<std::string> &column_names);

    /** Goes on with a file after its first @p n_rows rows; what came after them is cut off.
     * @throws WriteError if the file can't be written, InputError if it has fewer */
    CsvFile(const std::string &file, unsigned long n_rows);

    /** Goes on with a table of these columns after its last row whose first number, the step, is no
     * more than @p step, or begins one where there is none. @throws WriteError if the file can't be
     * written */
    CsvFile(const std::string &file,
            const std::vector<std::string> &column_names,
            unsigned int step);

    /** @throws WriteError if the disk is full */
    void
    write_row(const std::vector<double> &values);

    /** All at once. @throws WriteError if the disk is full */
    void
    write_rows(const std::vector<std::vector<double>> &rows);

  private:
    const std::string file;
    std::ofstream stream;
  };
} // namespace Supple

#endif
