#include <supple/live/hands.h>

#include <supple/base/error.h>
#include <supple/live/words.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>
#include <utility>

namespace Supple
{
  using dealii::Tensor;

  namespace
  {
    using SharedPath = std::shared_ptr<HandPath>;

    std::vector<Pull::End>
    ends_of(Words &words)
    {
      words.expect("by");
      std::vector<Pull::End> ends;
      for (const std::string &part : dealii::Utilities::split_string_list(words.rest(), ','))
        {
          Words of_end(part);
          Pull::End end;
          end.vertex    = of_end.vertex();
          end.stiffness = of_end.number("a stiffness");
          end.offset    = of_end.place();
          of_end.expect_end();
          if (end.stiffness <= 0.)
            of_end.refuse("a stiffness must be greater than 0");
          ends.push_back(end);
        }
      if (ends.empty())
        words.refuse("no vertex is pulled");
      return ends;
    }


    /** A path of a map, which must be there. */
    template <class Key>
    SharedPath
    path_in(const std::map<Key, SharedPath> &paths, const Key &key)
    {
      const auto found = paths.find(key);
      return found == paths.end() ? nullptr : found->second;
    }


    SharedPath
    copy_of(const SharedPath &path)
    {
      return std::make_shared<HandPath>(*path);
    }
  } // namespace


  bool
  may_be_set(const std::string &entry)
  {
    const std::string section = entry.substr(0, entry.find('/'));
    const std::string name    = entry.substr(std::min(entry.size(), section.size() + 1));
    if (section == "Material")
      return name != "Volumetric locking cure"; // the mesh is grouped for it
    if (section == "Time")
      return std::set<std::string>{"Step", "Method", "Relative tolerance", "Tangent"}.count(name) >
             0;
    if (section.rfind("Tool ", 0) == 0)
      return name == "Friction";
    return section == "Damping" || section == "Loads" || section == "Corotation" ||
           entry == "Contact/Friction";
  }


  Hands::Hands(const Hands &other)
    : grabbed(other.grabbed)
    , held(other.held)
    , tools(other.tools)
    , set(other.set)
  {
    for (auto &[vertex, grab] : grabbed)
      grab.path = copy_of(grab.path);
    for (auto &[vertex, path] : held)
      path = copy_of(path);
    for (auto &[name, path] : tools)
      path = copy_of(path);
  }


  Hands &
  Hands::operator=(const Hands &other)
  {
    Hands copy(other);
    swap(copy);
    return *this;
  }


  void
  Hands::swap(Hands &other)
  {
    grabbed.swap(other.grabbed);
    held.swap(other.held);
    tools.swap(other.tools);
    set.swap(other.set);
  }


  Hands::Effect
  Hands::apply(const std::string &text, const double time)
  {
    using Deed = void (Hands::*)(Words &, double);
    static const std::map<std::string, std::pair<Deed, Effect>> deeds = {
      {"grab", {&Hands::grab, Effect::changes}},
      {"hold", {&Hands::hold, Effect::changes}},
      {"move", {&Hands::move, Effect::moves}},
      {"release", {&Hands::release, Effect::changes}},
      {"take", {&Hands::take, Effect::changes}},
      {"tool", {&Hands::move_tool, Effect::moves}},
      {"set", {&Hands::set_entry, Effect::changes}},
      {"renew", {&Hands::nothing, Effect::changes}},
      {"wait", {&Hands::nothing, Effect::moves}}};

    Words words(text);
    const std::string what = words.word("a deed");
    const auto known       = deeds.find(what);
    if (known == deeds.end())
      words.refuse("there is no deed '" + what + "'");
    const auto &[deed, effect] = known->second;
    (this->*deed)(words, time);
    words.expect_end();
    return effect;
  }


  unsigned int
  Hands::free_vertex(Words &words) const
  {
    const unsigned int vertex = words.vertex();
    if (grabs(vertex) || holds(vertex))
      words.refuse("a hand has this vertex already");
    return vertex;
  }


  void
  Hands::grab(Words &words, const double time)
  {
    const unsigned int vertex = free_vertex(words);
    const auto path           = std::make_shared<HandPath>(words.place(), time);
    grabbed[vertex]           = {ends_of(words), path};
  }


  void
  Hands::hold(Words &words, const double time)
  {
    const unsigned int vertex = free_vertex(words);
    held[vertex]              = std::make_shared<HandPath>(words.place(), time);
  }


  void
  Hands::move(Words &words, const double time)
  {
    const unsigned int vertex = words.vertex();
    const auto grab           = grabbed.find(vertex);
    const SharedPath path     = grab == grabbed.end() ? path_in(held, vertex) : grab->second.path;
    if (!path)
      words.refuse("no hand has this vertex");
    move_path(*path, words, time);
  }


  void
  Hands::move_path(HandPath &path, Words &words, const double time)
  {
    const Tensor<1, 3> place = words.place();
    path.move(place, time, words.duration());
  }


  void
  Hands::release(Words &words, double)
  {
    const unsigned int vertex = words.vertex();
    if (grabbed.erase(vertex) + held.erase(vertex) == 0)
      words.refuse("no hand has this vertex");
  }


  void
  Hands::take(Words &words, const double time)
  {
    const std::string tool = words.word("the name of a tool");
    if (has_taken(tool))
      words.refuse("a hand has this tool already");
    tools[tool] = std::make_shared<HandPath>(words.place(), time);
  }


  void
  Hands::move_tool(Words &words, const double time)
  {
    const SharedPath path = path_in(tools, words.word("the name of a tool"));
    if (!path)
      words.refuse("no hand has taken this tool");
    move_path(*path, words, time);
  }


  void
  Hands::set_entry(Words &words, double)
  {
    const Override change{words.rest()};
    const auto equal = change.text.find('=');
    if (equal == std::string::npos || change.text.find('/') > equal)
      words.refuse("what is right is \"set Section/Entry=value\"");
    const std::string entry = change.entry();
    if (!may_be_set(entry))
      words.refuse("a session can't set " + entry +
                   "; it can set what leaves the mesh, the clamps and the output as they are");
    set[entry] = change.text.substr(equal + 1);
  }


  void
  Hands::nothing(Words &, double)
  {
  }


  std::vector<Override>
  Hands::overrides() const
  {
    std::vector<Override> list;
    for (const auto &[entry, value] : set)
      list.push_back({entry + "=" + value, "set in the session"});
    return list;
  }


  void
  Hands::put_into(Parameters &scene) const
  {
    for (const auto &[vertex, grab] : grabbed)
      scene.loads.pulls.push_back({grab.ends, grab.path});
    for (const auto &[vertex, path] : held)
      scene.constraints.by_hand.push_back({vertex, path});
    for (const auto &[name, path] : tools)
      {
        bool found = false;
        for (ToolParameters &tool : scene.tools)
          if (tool.name == name)
            {
              tool.hand = path;
              found     = true;
            }
        if (!found)
          throw InputError("There is no tool " + name + " in this scene.");
      }
  }
} // namespace Supple
