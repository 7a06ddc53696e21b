#ifndef supple_mailbox_h
#define supple_mailbox_h

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /**
   * Between the thread of the simulation and that of the server. Nothing piles up in it: commands
   * that follow each other in a place overwrite the older ones, of frames the newest one waits, and
   * of texts as many as have room.
   */
  class Mailbox
  {
  public:
    using Bytes = std::shared_ptr<const std::vector<unsigned char>>;

    /** What the page asks for. */
    struct Request
    {
      unsigned int number = 0; ///< the page counts them
      std::string text;
    };

    // By the server.

    /** Puts a request; a move of the same hand that still waits is replaced.
     * @return false if there is no room */
    bool
    put_request(const Request &request);

    /** A page has come, or has gone. */
    void
    set_present(bool present);

    /** The page is ready for so many frames. */
    void
    set_credit(unsigned int frames);

    /** The newest frame, once; null if there is none that was not taken. */
    Bytes
    take_frame();

    std::vector<std::string>
    take_texts();

    /** Is called, from the other thread, when there is something to take. */
    std::function<void()> notify = [] {};

    // By the simulation.

    /** Waits until there is a request or a page has come, but not beyond an instant. */
    void
    wait_until(std::chrono::steady_clock::time_point instant);

    std::vector<Request>
    take_requests();

    /** Whether a page has come since the last call. */
    bool
    take_arrival();

    /** Whether the page is ready for a frame, and none waits for it. */
    bool
    wants_frame();

    void
    put_frame(Bytes frame);

    /** Where there is no room the oldest one goes, of those that are droppable if there are any. */
    void
    put_text(std::string text, bool droppable);

  private:
    static constexpr std::size_t most_requests = 64, most_texts = 16;

    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Request> requests;
    std::deque<std::pair<std::string, bool>> texts;
    Bytes frame;
    unsigned int credit = 0;
    bool present = false, arrived = false;
  };
} // namespace Supple

#endif
