#include <supple/live/hands.h>

#include <supple/base/error.h>

#include <array>
#include <cmath>
#include <set>
#include <sstream>

namespace Supple
{
  using dealii::Tensor;

  namespace
  {
    using SharedPath = std::shared_ptr<HandPath>;

    /** The words of a deed, one after the other. */
    class Words
    {
    public:
      explicit Words(const std::string &text)
        : text(text)
        , words(text)
      {
      }

      std::string
      word(const std::string &what)
      {
        std::string found;
        if (!(words >> found))
          refuse(what + " is missing");
        return found;
      }

      void
      expect(const std::string &wanted)
      {
        if (const std::string found = word("'" + wanted + "'"); found != wanted)
          refuse("found '" + found + "' where '" + wanted + "' must be");
      }

      double
      number(const std::string &what)
      {
        const std::string found = word(what);
        char *end;
        const double value = std::strtod(found.c_str(), &end);
        if (*end != '\0' || !std::isfinite(value))
          refuse(what + " is '" + found + "', not a finite number");
        return value;
      }

      unsigned int
      vertex()
      {
        const double value = number("the index of a vertex");
        if (value < 0. || value != std::floor(value) || value > 4e9)
          refuse("the index of a vertex must be a whole number");
        return static_cast<unsigned int>(value);
      }

      Tensor<1, 3>
      place()
      {
        Tensor<1, 3> place;
        for (unsigned int i = 0; i < 3; ++i)
          place[i] = number(std::string("coordinate ") + "xyz"[i]);
        return place;
      }

      double
      duration()
      {
        expect("over");
        const double duration = number("a duration");
        if (duration <= 0.)
          refuse("a duration must be greater than 0");
        return duration;
      }

      std::string
      rest()
      {
        std::string rest;
        std::getline(words >> std::ws, rest);
        return rest;
      }

      void
      expect_end()
      {
        if (const std::string more = rest(); !more.empty())
          refuse("nothing more may follow, and there is '" + more + "'");
      }

      [[noreturn]] void
      refuse(const std::string &why) const
      {
        throw InputError("\"" + text + "\": " + why + ".");
      }

    private:
      const std::string text;
      std::istringstream words;
    };


    std::vector<Pull::End>
    ends_of(Words &words)
    {
      words.expect("by");
      std::vector<Pull::End> ends;
      std::istringstream list(words.rest());
      for (std::string part; std::getline(list, part, ',');)
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
    grabbed.swap(copy.grabbed);
    held.swap(copy.held);
    tools.swap(copy.tools);
    set.swap(copy.set);
    return *this;
  }


  Hands::Effect
  Hands::apply(const std::string &text, const double time)
  {
    Words words(text);
    const std::string what = words.word("a deed");
    if (what == "grab" || what == "hold")
      {
        const unsigned int vertex = words.vertex();
        if (grabs(vertex) || holds(vertex))
          words.refuse("a hand has this vertex already");
        const auto path = std::make_shared<HandPath>(words.place(), time);
        if (what == "grab")
          grabbed[vertex] = {ends_of(words), path};
        else
          {
            words.expect_end();
            held[vertex] = path;
          }
        return Effect::changes;
      }
    if (what == "move")
      {
        const unsigned int vertex = words.vertex();
        const auto grab           = grabbed.find(vertex);
        const SharedPath path = grab == grabbed.end() ? path_in(held, vertex) : grab->second.path;
        if (!path)
          words.refuse("no hand has this vertex");
        const Tensor<1, 3> place = words.place();
        const double duration    = words.duration();
        words.expect_end();
        path->move(place, time, duration);
        return Effect::moves;
      }
    if (what == "release")
      {
        const unsigned int vertex = words.vertex();
        words.expect_end();
        if (grabbed.erase(vertex) + held.erase(vertex) == 0)
          words.refuse("no hand has this vertex");
        return Effect::changes;
      }
    if (what == "take")
      {
        const std::string tool = words.word("the name of a tool");
        if (has_taken(tool))
          words.refuse("a hand has this tool already");
        const Tensor<1, 3> place = words.place();
        words.expect_end();
        tools[tool] = std::make_shared<HandPath>(place, time);
        return Effect::changes;
      }
    if (what == "tool")
      {
        const SharedPath path = path_in(tools, words.word("the name of a tool"));
        if (!path)
          words.refuse("no hand has taken this tool");
        const Tensor<1, 3> place = words.place();
        const double duration    = words.duration();
        words.expect_end();
        path->move(place, time, duration);
        return Effect::moves;
      }
    if (what == "set")
      {
        const std::string all = words.rest();
        const Override change{all};
        if (all.find('=') == std::string::npos || all.find('/') > all.find('='))
          words.refuse("what is right is \"set Section/Entry=value\"");
        if (!may_be_set(change.entry()))
          words.refuse("a session can't set " + change.entry() +
                       "; it can set what leaves the mesh, the clamps and the output as they are");
        set[change.entry()] = all.substr(all.find('=') + 1);
        return Effect::changes;
      }
    if (what != "renew")
      words.refuse("there is no deed '" + what + "'");
    words.expect_end();
    return Effect::changes;
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
