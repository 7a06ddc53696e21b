#ifndef supple_gnuplot_h
#define supple_gnuplot_h

#include <string>

namespace Supple
{
  /** A text as a script of gnuplot holds it. */
  std::string
  quoted(const std::string &text);


  /**
   * Has gnuplot run FOLDER/PLOT.gp, with the folder as its argument.
   * @return what went wrong, in a sentence; empty if nothing did
   */
  std::string
  draw(const std::string &folder, const std::string &plot);
} // namespace Supple

#endif
