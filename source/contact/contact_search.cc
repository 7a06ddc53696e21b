#include <supple/contact/contact_search.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    , searched_of_tools(tools.size())
  {
    lists.of_tools.resize(tools.size());
  }


  namespace
  {
    /** Those of the nodes of the surface, of values at all local nodes. */
    void
    take(std::vector<Arrow> &list, const ContactSurface &surface, const double *const values)
    {
      list.clear();
      for (const unsigned int node : surface.nodes)
        list.push_back(Arrow({values[3 * node], values[3 * node + 1], values[3 * node + 2]}));
    }
  } // namespace


  double
  ContactSearch::nearest_part(const Searched &searched,
                              const std::vector<Arrow> &u,
                              const Pose *const pose) const
  {
    double along = 0., square = 0.;
    for (std::size_t k = 0; k < searched.way.size(); ++k)
      {
        along += searched.way[k] * (u[k] - searched.start[k]);
        square += searched.way[k].norm_square();
      }
    if (!(square > 0.) && pose)
      {
        const auto &[from, to] = searched.tool;
        along                  = (to.place - from.place) * (pose->place - from.place) +
                (to.turn - from.turn) * (pose->turn - from.turn);
        square = (to.place - from.place).norm_square() + (to.turn - from.turn).norm_square();
      }
    return square > 0. ? std::clamp(along / square, 0., 1.) : 0.;
  }


  bool
  ContactSearch::covers(const Searched &searched,
                        const std::vector<Arrow> &u,
                        const Tool *const tool,
                        const Pose &pose) const
  {
    if (searched.start.size() != u.size() || u.empty())
      return u.empty();
    const double part = nearest_part(searched, u, tool ? &pose : nullptr);
    const auto off    = [&](const std::size_t k) {
      return searched.way.empty() ? u[k] - searched.start[k]
                                     : u[k] - searched.start[k] - part * searched.way[k];
    };
    if (!tool) // either part may be off by this, as seen from the mean
      {
        Arrow mean;
        for (std::size_t k = 0; k < u.size(); ++k)
          mean += off(k) / double(u.size());
        for (std::size_t k = 0; k < u.size(); ++k)
          if (!(2. * (off(k) - mean).norm() <= searched.margin)) // nor where it is not a number
            return false;
        return true;
      }
    const Pose there  = between(searched.tool.from, searched.tool.to, part);
    const Arrow shift = pose.place - there.place;
    const double turn = (pose.turn - there.turn).norm();
    for (std::size_t k = 0; k < u.size(); ++k)
      {
        const double moved = (off(k) - shift).norm();
        const double lever =
          turn == 0.
            ? 0.
            : (tool->is_plane()
                 ? (Arrow(surface.body.position(surface.nodes[k])) + u[k] - pose.place).norm()
                 : tool->shape->lever);
        if (!(moved + turn * lever <= searched.margin))
          return false;
      }
    return true;
  }


  double
  ContactSearch::least_distance(const Tool &tool, const Searched &searched) const
  {
    const auto &[from, to] = searched.tool;
    const double turn      = (to.turn - from.turn).norm();
    Box box;
    double lowest = std::numeric_limits<double>::max(), farthest = 0.;
    for (std::size_t k = 0; k < searched.start.size(); ++k)
      {
        const Arrow place = Arrow(surface.body.position(surface.nodes[k])) + searched.start[k];
        const Arrow way   = searched.way.empty() ? Arrow() : searched.way[k];
        for (const Arrow &there : {place - from.place, place + way - to.place})
          {
            const Arrow in_frame = from.turned_back(there);
            box.take(in_frame);
            farthest = std::max(farthest, there.norm());
            if (tool.is_plane())
              lowest = std::min(lowest, tool.parameters.normal * in_frame);
          }
      }
    const double nearest =
      tool.is_plane() ? lowest / tool.parameters.normal.norm() : box.distance(tool.shape->bounds);
    return nearest - turn * farthest - tool.offset - tool.reach;
  }


  void
  ContactSearch::search_tool(const unsigned int t,
                             const SurfaceMotion &motion,
                             const ToolMotion &way)
  {
    Searched &searched = searched_of_tools[t];
    keep(searched, motion);
    searched.tool        = way;
    const double nothing = least_distance(tools[t], searched);
    if (nothing > margin)
      {
        lists.of_tools[t] = {};
        searched.margin   = nothing;
        return;
      }
    lists.of_tools[t] = candidates_of(surface, motion, tools[t], way, tools[t].reach + margin);
  }


  void
  ContactSearch::keep(Searched &searched, const SurfaceMotion &motion) const
  {
    take(searched.start, surface, motion.u);
    searched.way.clear();
    if (motion.way)
      take(searched.way, surface, motion.way);
    searched.margin = margin;
  }


  void
  ContactSearch::search_own_state(const double *const u)
  {
    own_of_state = covers(searched_own_way, start, nullptr, {})
                     ? near_ones(own_of_way, surface, u, reach + margin)
                     : own_candidates(surface, {u}, bodies == Bodies::pieces, reach + margin);
    keep(searched_own_state, {u});
  }


  void
  ContactSearch::search_own_way(const SurfaceMotion &motion)
  {
    // what is near a state that is near the way must be among them
    own_of_way = own_candidates(surface, motion, bodies == Bodies::pieces, reach + 2. * margin);
    keep(searched_own_way, motion);
  }


  const AllCandidates &
  ContactSearch::find(const SurfaceMotion &motion, const std::vector<ToolMotion> &ways)
  {
    take(start, surface, motion.u);
    end = start;
    if (motion.way)
      {
        take(end, surface, motion.way);
        for (std::size_t k = 0; k < end.size(); ++k)
          end[k] += start[k];
      }
    for (unsigned int t = 0; t < tools.size(); ++t)
      if (!covers(searched_of_tools[t], start, &tools[t], ways[t].from) ||
          !covers(searched_of_tools[t], end, &tools[t], ways[t].to))
        search_tool(t, motion, ways[t]);
    lists.own = &own_of_state;
    if (bodies == Bodies::tools)
      return lists;
    const auto cover = [&](const Searched &searched) {
      return covers(searched, start, nullptr, {}) && covers(searched, end, nullptr, {});
    };
    if (cover(searched_own_state))
      return lists;
    if (!motion.way)
      {
        search_own_state(motion.u);
        return lists;
      }
    if (!cover(searched_own_way))
      search_own_way(motion);
    lists.own = &own_of_way;
    return lists;
  }


  const AllCandidates &
  ContactSearch::find(const double *const u, const std::vector<Pose> &poses)
  {
    std::vector<ToolMotion> ways;
    for (const Pose &pose : poses)
      ways.push_back({pose, pose});
    return find({u}, ways);
  }


  Candidates
  ContactSearch::own(const double *const u) const
  {
    if (bodies == Bodies::tools)
      return {};
    return own_candidates(surface, {u}, bodies == Bodies::pieces, reach);
  }
} // namespace Supple
