#include <supple/run/listener.h>

#include <nlohmann/json.hpp>

namespace Supple
{
  nlohmann::json
  Listener::save() const
  {
    return nullptr;
  }


  void
  Listener::load(const nlohmann::json &)
  {
  }


  void
  Listeners::add(Listener *const listener)
  {
    if (listener)
      list.push_back(listener);
  }


  std::string
  Listeners::objection(const Observation &now) const
  {
    for (Listener *const listener : list)
      if (const std::string text = listener->objection(now); !text.empty())
        return text;
    return "";
  }


  void
  Listeners::begin(const Observation &now, const bool resumed) const
  {
    for (Listener *const listener : list)
      listener->begin(now, resumed);
  }


  bool
  Listeners::after_step(const Observation &now) const
  {
    bool goes_on = true;
    for (Listener *const listener : list)
      goes_on = listener->after_step(now) && goes_on;
    return goes_on;
  }


  void
  Listeners::interrupted(const Observation &now) const
  {
    for (Listener *const listener : list)
      listener->interrupted(now);
  }


  void
  Listeners::end(const Observation &now) const
  {
    for (Listener *const listener : list)
      listener->end(now);
  }


  void
  Listeners::save(nlohmann::json &kept) const
  {
    for (const Listener *const listener : list)
      if (!listener->name().empty())
        kept[listener->name()] = listener->save();
  }


  void
  Listeners::load(const nlohmann::json &kept) const
  {
    for (Listener *const listener : list)
      if (!listener->name().empty() && kept.contains(listener->name()))
        listener->load(kept.at(listener->name()));
  }


  std::vector<Vector *>
  Listeners::kept_vectors() const
  {
    std::vector<Vector *> vectors;
    for (Listener *const listener : list)
      if (Vector *const vector = listener->kept_vector())
        vectors.push_back(vector);
    return vectors;
  }
} // namespace Supple
