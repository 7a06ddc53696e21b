#include <supple/live/mailbox.h>

#include <algorithm>
#include <sstream>

namespace Supple
{
  namespace
  {
    /** "move 57 " or "tool needle " of a request; empty of others. */
    std::string
    moved_by(const std::string &text)
    {
      std::istringstream words(text);
      std::string what, whom;
      words >> what >> whom;
      return what == "move" || what == "tool" ? what + " " + whom + " " : "";
    }
  } // namespace


  bool
  Mailbox::put_request(const Request &request)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      const std::string moved = moved_by(request.text);
      if (!moved.empty() && !requests.empty() && requests.back().text.rfind(moved, 0) == 0)
        requests.back() = request;
      else if (requests.size() == most_requests)
        return false;
      else
        requests.push_back(request);
    }
    changed.notify_all();
    return true;
  }


  void
  Mailbox::set_present(const bool here)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      present = here;
      credit  = 0;
      frame.reset();
      texts.clear();
      arrived = here;
    }
    changed.notify_all();
  }


  void
  Mailbox::set_credit(const unsigned int frames)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    credit = frames;
  }


  Mailbox::Bytes
  Mailbox::take_frame()
  {
    const std::lock_guard<std::mutex> lock(mutex);
    return std::exchange(frame, nullptr);
  }


  std::vector<std::string>
  Mailbox::take_texts()
  {
    const std::lock_guard<std::mutex> lock(mutex);
    std::vector<std::string> all;
    for (auto &[text, droppable] : texts)
      all.push_back(std::move(text));
    texts.clear();
    return all;
  }


  void
  Mailbox::wait_until(const std::chrono::steady_clock::time_point instant)
  {
    std::unique_lock<std::mutex> lock(mutex);
    changed.wait_until(lock, instant, [this] { return !requests.empty() || arrived; });
  }


  std::vector<Mailbox::Request>
  Mailbox::take_requests()
  {
    const std::lock_guard<std::mutex> lock(mutex);
    std::vector<Request> all(requests.begin(), requests.end());
    requests.clear();
    return all;
  }


  bool
  Mailbox::take_arrival()
  {
    const std::lock_guard<std::mutex> lock(mutex);
    return std::exchange(arrived, false);
  }


  bool
  Mailbox::wants_frame()
  {
    const std::lock_guard<std::mutex> lock(mutex);
    return present && credit > 0 && !frame;
  }


  void
  Mailbox::put_frame(Bytes next)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!present)
        return;
      frame = std::move(next);
    }
    notify();
  }


  void
  Mailbox::put_text(std::string text, const bool droppable)
  {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!present)
        return;
      if (texts.size() >= most_texts)
        {
          const auto oldest = std::find_if(texts.begin(), texts.end(), [](const auto &waiting) {
            return waiting.second;
          });
          texts.erase(oldest == texts.end() ? texts.begin() : oldest);
        }
      texts.emplace_back(std::move(text), droppable);
    }
    notify();
  }
} // namespace Supple
