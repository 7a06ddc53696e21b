#include <supple/base/csv_file.h>

#include <supple/base/error.h>
#include <supple/base/files.h>

#include <boost/algorithm/string/join.hpp>

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace Supple
{
  namespace
  {
    /** A table after its last row of a step; the header alone if there is no such table. */
    std::string
    up_to_step(const std::string &file, const std::string &header, const unsigned int step)
    {
      std::istringstream old(content_of(file));
      std::string text = header + '\n', line;
      if (!std::getline(old, line) || line != header)
        return text;
      while (std::getline(old, line) && std::strtod(line.c_str(), nullptr) <= step)
        text += line + '\n';
      return text;
    }
  } // namespace


  CsvFile::CsvFile(const std::string &file, const std::vector<std::string> &column_names)
    : file(file)
    , stream(file)
  {
    stream << boost::algorithm::join(column_names, ",") << std::endl;
    if (!stream)
      throw WriteError(file + " can't be written.");
  }


  CsvFile::CsvFile(const std::string &file,
                   const std::vector<std::string> &column_names,
                   const unsigned int step)
    : file(file)
  {
    write_whole_file(file, up_to_step(file, boost::algorithm::join(column_names, ","), step));
    stream.open(file, std::ios::app);
    if (!stream)
      throw WriteError(file + " can't be written.");
  }


  namespace
  {
    void
    cut_after_rows(const std::string &file, const unsigned long n_rows)
    {
      std::ifstream stream(file);
      std::ostringstream kept;
      std::string line;
      for (unsigned long row = 0; row <= n_rows; ++row)
        {
          if (!std::getline(stream, line))
            throw InputError(file + " has fewer rows than the checkpoint beside it knows of: " +
                             "begin anew with Checkpoint/Resume = never.");
          kept << line << '\n';
        }
      write_whole_file(file, kept.str());
    }
  } // namespace


  CsvFile::CsvFile(const std::string &file, const unsigned long n_rows)
    : file(file)
  {
    cut_after_rows(file, n_rows);
    stream.open(file, std::ios::app);
    if (!stream)
      throw WriteError(file + " can't be written.");
  }


  void
  CsvFile::write_row(const std::vector<double> &values)
  {
    write_rows({values});
  }


  void
  CsvFile::write_rows(const std::vector<std::vector<double>> &rows)
  {
    std::ostringstream text; // the rows go to the disk in one piece
    text.precision(15);
    for (const std::vector<double> &row : rows)
      {
        for (std::size_t i = 0; i < row.size(); ++i)
          {
            text << (i == 0 ? "" : ",");
            if (!std::isnan(row[i]))
              text << row[i];
          }
        text << '\n';
      }
    stream << text.str() << std::flush;
    if (!stream)
      throw WriteError(file + " can't be written any more; is the disk full?");
  }
} // namespace Supple
