#include <supple/error.h>
#include <supple/tables.h>

#include <cstdio>
#include <filesystem>
#include <sstream>

namespace Supple
{
  CsvFile::CsvFile(const std::string &file, const std::vector<std::string> &column_names)
    : file(file)
    , stream(file)
  {
    for (std::size_t i = 0; i < column_names.size(); ++i)
      stream << (i == 0 ? "" : ",") << column_names[i];
    stream << std::endl;
    if (!stream)
      throw WriteError(file + " can't be written.");
  }


  void
  CsvFile::write_row(const std::vector<double> &values)
  {
    std::ostringstream row; // the row goes to the disk in one piece
    row.precision(15);
    for (std::size_t i = 0; i < values.size(); ++i)
      row << (i == 0 ? "" : ",") << values[i];
    row << '\n';
    stream << row.str() << std::flush;
    if (!stream)
      throw WriteError(file + " can't be written any more; is the disk full?");
  }


  void
  write_whole_file(const std::string &file, const std::string &content)
  {
    const std::string aside = file + ".partial";
    {
      std::ofstream stream(aside);
      stream << content << std::flush;
      if (!stream)
        {
          stream.close();
          std::remove(aside.c_str());
          throw WriteError(file + " can't be written; is the disk full?");
        }
    }
    std::filesystem::rename(aside, file);
  }
} // namespace Supple
