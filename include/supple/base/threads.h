#ifndef supple_threads_h
#define supple_threads_h

#include <deal.II/base/parallel.h>

namespace Supple
{
  /**
   * Calls task(0), ..., task(n_tasks - 1), each once, by TBB on as many threads as deal.II may use
   * (dealii::MultithreadInfo), and returns when all are done: about a microsecond after the last
   * where processors are idle. Where they are not, this thread does all of them by itself.
   *
   * The work is cut the same way whoever does it: so results do not depend on timing.
   */
  template <class Task>
  inline void
  run_tasks(const unsigned int n_tasks, const Task &task)
  {
    if (n_tasks == 1)
      task(0u);
    else
      dealii::parallel::apply_to_subranges(
        0u,
        n_tasks,
        [&task](const unsigned int begin, const unsigned int end) {
          for (unsigned int number = begin; number < end; ++number)
            task(number);
        },
        1);
  }
} // namespace Supple

#endif
