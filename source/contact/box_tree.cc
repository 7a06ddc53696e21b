#include <supple/contact/box_tree.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Supple
{
  void
  Box::take(const Arrow &point)
  {
    for (unsigned int i = 0; i < 3; ++i)
      {
        low[i]  = std::min(low[i], point[i]);
        high[i] = std::max(high[i], point[i]);
      }
  }


  void
  Box::take(const Simplex &simplex)
  {
    for (unsigned int v = 0; v < simplex.n; ++v)
      take(simplex.x[v]);
  }


  void
  Box::grow(const double distance)
  {
    for (unsigned int i = 0; i < 3; ++i)
      {
        low[i] -= distance;
        high[i] += distance;
      }
  }


  bool
  Box::overlaps(const Box &other) const
  {
    for (unsigned int i = 0; i < 3; ++i)
      if (low[i] > other.high[i] || other.low[i] > high[i])
        return false;
    return true;
  }


  double
  Box::distance(const Box &other) const
  {
    double square = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double gap = std::max({0., low[i] - other.high[i], other.low[i] - high[i]});
        square += gap * gap;
      }
    return std::sqrt(square);
  }


  namespace
  {
    dealii::BoundingBox<3>
    as_deal_ii_box(const Box &box)
    {
      return dealii::BoundingBox<3>({dealii::Point<3>(box.low), dealii::Point<3>(box.high)});
    }
  } // namespace


  struct BoxTree::Tree
  {
    dealii::RTree<std::pair<dealii::BoundingBox<3>, unsigned int>> tree;
    mutable std::vector<std::pair<dealii::BoundingBox<3>, unsigned int>> found; ///< at hand
  };


  BoxTree::BoxTree(const std::vector<Box> &boxes)
    : tree(std::make_unique<Tree>())
  {
    std::vector<std::pair<dealii::BoundingBox<3>, unsigned int>> leaves;
    leaves.reserve(boxes.size());
    for (unsigned int number = 0; number < boxes.size(); ++number)
      leaves.emplace_back(as_deal_ii_box(boxes[number]), number);
    tree->tree = dealii::pack_rtree(leaves);
  }


  BoxTree::~BoxTree() = default;


  void
  BoxTree::find(const Box &box, std::vector<unsigned int> &numbers) const
  {
    namespace index = boost::geometry::index;

    tree->found.clear();
    tree->tree.query(index::intersects(as_deal_ii_box(box)), std::back_inserter(tree->found));
    numbers.clear();
    for (const auto &[there, number] : tree->found)
      numbers.push_back(number);
    std::sort(numbers.begin(), numbers.end());
  }
} // namespace Supple
