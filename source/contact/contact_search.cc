#include <supple/contact/contact_search.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using Bodies = ContactParameters::Bodies;

  ContactSearch::ContactSearch(const ContactSurface &surface,
                               const std::vector<Tool> &tools,
                               const double reach,
                               const Bodies bodies)
    : surface(surface)
    , tools(tools)
    , reach(reach)
    , bodies(bodies)
    , margin(std::max(2. * reach, 0.1 * surface.mean_edge()))
    , places(tools.size() + 1)
    , poses(tools.size())
  {
    lists.of_tools.resize(tools.size());
    lists_of_way.of_tools.resize(tools.size());
  }


  namespace
  {
    Arrow
    at(const double *const values, const unsigned int node)
    {
      return Arrow({values[3 * node], values[3 * node + 1], values[3 * node + 2]});
    }


    void
    keep_places(std::vector<Arrow> &places, const ContactSurface &surface, const double *const u)
    {
      places.clear();
      for (const unsigned int node : surface.nodes)
        places.push_back(at(u, node));
    }


    /** Displacement since the places were kept, and on a way from there on [m]. */
    Arrow
    gone(const Arrow &place,
         const double *const u,
         const double *const way,
         const unsigned int node)
    {
      return at(u, node) - place + (way ? at(way, node) : Arrow());
    }
  } // namespace


  double
  ContactSearch::change(const unsigned int tool,
                        const double *const u,
                        const double *const way,
                        const Pose &pose) const
  {
    if (places[tool].size() != surface.nodes.size())
      return std::numeric_limits<double>::max();
    const Arrow shift = pose.place - poses[tool].place;
    const double turn = (pose.turn - poses[tool].turn).norm();
    const Tool &which = tools[tool];
    double largest    = 0.;
    for (std::size_t k = 0; k < surface.nodes.size(); ++k)
      {
        const unsigned int node = surface.nodes[k];
        double moved            = (gone(places[tool][k], u, way, node) - shift).norm();
        if (which.is_plane() && turn > 0.)
          moved += turn * (Arrow(surface.body.position(node)) + at(u, node) - pose.place).norm();
        largest = std::max(largest, moved);
      }
    return which.is_plane() ? largest : largest + turn * which.shape->lever;
  }


  /** Of two parts, each may have moved by this much as seen from the mean motion. */
  double
  ContactSearch::own_change(const double *const u, const double *const way) const
  {
    const std::vector<Arrow> &before = places.back();
    if (before.size() != surface.nodes.size())
      return std::numeric_limits<double>::max();
    Arrow mean;
    for (std::size_t k = 0; k < before.size(); ++k)
      mean += gone(before[k], u, way, surface.nodes[k]);
    mean /= std::max<std::size_t>(1, before.size());
    double square = 0.;
    for (std::size_t k = 0; k < before.size(); ++k)
      square =
        std::max(square, (gone(before[k], u, way, surface.nodes[k]) - mean).norm_square());
    return 2. * std::sqrt(square);
  }


  Candidates
  ContactSearch::own(const double *const u, const double margin) const
  {
    if (bodies == Bodies::tools)
      return {};
    return own_candidates(surface, {u}, bodies == Bodies::pieces, reach + margin);
  }


  const AllCandidates &
  ContactSearch::near(const double *const u, const std::vector<Pose> &now)
  {
    for (unsigned int t = 0; t < tools.size(); ++t)
      if (change(t, u, nullptr, now[t]) > margin)
        {
          lists.of_tools[t] =
            candidates_of(surface, {u}, tools[t], {now[t], now[t]}, tools[t].reach + margin);
          keep_places(places[t], surface, u);
          poses[t] = now[t];
        }
    if (bodies != Bodies::tools && own_change(u, nullptr) > margin)
      {
        lists.own = own(u, margin);
        keep_places(places.back(), surface, u);
      }
    return lists;
  }


  const AllCandidates &
  ContactSearch::on_way(const double *const u,
                        const double *const way,
                        const std::vector<ToolMotion> &motions)
  {
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        const bool known = change(t, u, way, motions[t].to) <= margin &&
                           change(t, u, nullptr, motions[t].from) <= margin;
        lists_of_way.of_tools[t] =
          known ? lists.of_tools[t]
                : candidates_of(surface, {u, way}, tools[t], motions[t], tools[t].reach);
      }
    if (bodies != Bodies::tools)
      {
        const bool known = own_change(u, way) <= margin && own_change(u, nullptr) <= margin;
        lists_of_way.own =
          known ? lists.own
                : own_candidates(surface, {u, way}, bodies == Bodies::pieces, reach);
      }
    return lists_of_way;
  }
} // namespace Supple
