#ifndef supple_box_tree_h
#define supple_box_tree_h

#include <supple/contact/closest_points.h>

#include <limits>
#include <memory>
#include <vector>

namespace Supple
{
  /** A box along the axes; without points there is nothing in it. */
  struct Box
  {
    Arrow low{{huge, huge, huge}};     ///< [m]
    Arrow high{{-huge, -huge, -huge}}; ///< [m]

    /** Makes room for a point. */
    void
    take(const Arrow &point);

    void
    take(const Simplex &simplex);

    /** Makes room for all that is no farther away. */
    void
    grow(double distance);

    bool
    overlaps(const Box &other) const;

    /** No more than between any points of the two [m]. */
    double
    distance(const Box &other) const;

  private:
    static constexpr double huge = std::numeric_limits<double>::max();
  };


  /** Boxes, to be asked which of them overlap another one: Boost's R-tree. */
  class BoxTree
  {
  public:
    explicit BoxTree(const std::vector<Box> &boxes);
    ~BoxTree();

    /** Sets @p numbers to those of the boxes that overlap, in ascending order. */
    void
    find(const Box &box, std::vector<unsigned int> &numbers) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree;
  };
} // namespace Supple

#endif
