/**
 * Runs the scene of a test and prints what is physical in it: a few rows of history.csv and
 * probes.csv, each column divided by its largest value, so that numbers of order one with ten
 * digits can be compared.
 */

#include <supple/base/error.h>
#include <supple/run/simulation.h>
#include <supple/scene/read_scene.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

namespace
{
  struct Table
  {
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;
  };


  Table
  read_csv(const std::string &file)
  {
    Table table;
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    table.names = dealii::Utilities::split_string_list(line, ',');
    while (std::getline(stream, line))
      table.rows.push_back(
        dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(line, ',')));
    return table;
  }


  /** The components of a vector are compared by the size of the vector. */
  std::string
  without_direction(const std::string &name)
  {
    const bool component = name.size() > 1 && name.find_last_of("xyz") == name.size() - 1;
    return component ? name.substr(0, name.size() - 1) : name;
  }


  void
  print(const std::string &title, const Table &table)
  {
    std::map<std::string, double> largest;
    for (const auto &row : table.rows)
      for (std::size_t c = 0; c < row.size(); ++c)
        {
          double &size = largest[without_direction(table.names[c])];
          size         = std::max(size, std::abs(row[c]));
        }

    const std::set<std::string> not_physical = {"step",
                                                "newton_iterations",
                                                "linear_iterations",
                                                "seconds"};
    const std::set<std::size_t> chosen       = {0, 1, 2, 5, 10, 20, 50, table.rows.size() - 1};
    std::printf("%s: %zu rows\n", title.c_str(), table.rows.size());
    for (std::size_t c = 0; c < table.names.size(); ++c)
      {
        if (not_physical.count(table.names[c]) > 0)
          continue;
        const double size = largest[without_direction(table.names[c])];
        std::printf("%s, largest %.9e:", table.names[c].c_str(), size);
        for (const std::size_t r : chosen)
          if (r < table.rows.size())
            std::printf(" %.10f", size > 0. ? table.rows[r][c] / size : 0.);
        std::printf("\n");
      }
    std::fflush(stdout);
  }
} // namespace


int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  try
    {
      const auto parameters = Supple::read_scene(argv[1]);
      Supple::Simulation simulation(parameters, "results", true, MPI_COMM_WORLD);
      simulation.run();
    }
  catch (const std::exception &exception)
    {
      if (root)
        std::cout << exception.what() << std::endl;
      return 1;
    }
  if (root)
    {
      print("history", read_csv("results/history.csv"));
      if (std::ifstream("results/probes.csv"))
        print("probes", read_csv("results/probes.csv"));
    }
  return 0;
}
