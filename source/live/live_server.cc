#include <supple/live/live_server.h>

#include <supple/base/error.h>

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <boost/beast/websocket.hpp>

#include <cctype>
#include <cstdio>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <thread>
#include <utility>

namespace Supple
{
  namespace asio      = boost::asio;
  namespace beast     = boost::beast;
  namespace http      = beast::http;
  namespace websocket = beast::websocket;
  using tcp           = asio::ip::tcp;
  using Error         = beast::error_code;
  using HttpRequest   = http::request<http::string_body>;
  using HttpAnswer    = http::response<http::string_body>;

  namespace
  {
    constexpr std::size_t longest_request = 4096, longest_head = 8192;
    constexpr std::chrono::seconds patience(10); ///< with a request, before it is whole
    constexpr unsigned int most_credit = 8;

    /** 128 random bits, as hexadecimal digits. */
    std::string
    random_token()
    {
      std::random_device source;
      std::string token;
      for (unsigned int word = 0; word < 4; ++word)
        {
          char digits[9];
          std::snprintf(digits, sizeof(digits), "%08x", static_cast<unsigned int>(source()));
          token += digits;
        }
      return token;
    }


    /** A page that may connect to this server, as no report may connect to anything. */
    std::string
    with_connection(std::string page, const std::string &host)
    {
      const std::string nothing = "connect-src 'none'";
      const auto place          = page.find(nothing);
      if (place == std::string::npos)
        throw WriteError("The page of a session has no policy for what it may connect to.");
      return page.replace(place, nothing.size(), "connect-src 'self' ws://" + host);
    }


    /** Takes as long whatever differs. */
    bool
    are_equal(const std::string &one, const std::string &other)
    {
      if (one.size() != other.size())
        return false;
      unsigned int difference = 0;
      for (std::size_t i = 0; i < one.size(); ++i)
        difference |= static_cast<unsigned char>(one[i]) ^ static_cast<unsigned char>(other[i]);
      return difference == 0;
    }


    /** "NUMBER TEXT" taken apart; number 0 where there is none. */
    Mailbox::Request
    request_of(const std::string &message)
    {
      const auto blank = message.find(' ');
      Mailbox::Request request;
      if (blank == std::string::npos || blank == 0 || blank > 9)
        return request;
      for (std::size_t i = 0; i < blank; ++i)
        if (std::isdigit(static_cast<unsigned char>(message[i])) == 0)
          return request;
      for (const char letter : message)
        if (letter < ' ' && letter >= 0)
          return request;
      request.number = std::stoul(message.substr(0, blank));
      request.text   = message.substr(blank + 1);
      return request;
    }
  } // namespace


  /** The socket of the page. */
  class LiveSocket : public std::enable_shared_from_this<LiveSocket>
  {
  public:
    LiveSocket(tcp::socket socket, Mailbox &mailbox)
      : stream(std::move(socket))
      , mailbox(mailbox)
    {
    }

    ~LiveSocket()
    {
      if (open)
        mailbox.set_present(false);
    }

    void
    start(HttpRequest request)
    {
      stream.read_message_max(longest_request);
      stream.auto_fragment(false);
      stream.write_buffer_bytes(1 << 18);
      beast::get_lowest_layer(stream).expires_never();
      Error ignored;
      beast::get_lowest_layer(stream).socket().set_option(tcp::no_delay(true), ignored);
      stream.set_option(
        websocket::stream_base::timeout{std::chrono::seconds(30), std::chrono::seconds(30), true});
      const auto kept = std::make_shared<HttpRequest>(std::move(request));
      stream.async_accept(*kept, [self = shared_from_this(), kept](const Error &error) {
        if (error)
          return;
        self->open = true;
        self->mailbox.set_present(true);
        self->read();
      });
    }

    /** Sends what waits. */
    void
    write()
    {
      if (writing || !open || closing)
        return;
      for (std::string &text : mailbox.take_texts())
        texts.push_back(std::move(text));
      if (!texts.empty())
        {
          text = std::move(texts.front());
          texts.pop_front();
          send(asio::buffer(text), true);
        }
      else if (credit > 0)
        if ((frame = mailbox.take_frame()))
          {
            --credit;
            mailbox.set_credit(credit);
            send(asio::buffer(*frame), false);
          }
    }

    /** Tells the page why. */
    void
    close(const websocket::close_code code, const std::string &reason)
    {
      if (!open || std::exchange(closing, true))
        return;
      stream.async_close({code, reason.substr(0, 120)},
                         [self = shared_from_this()](const Error &) {});
    }

  private:
    void
    read()
    {
      stream.async_read(buffer, [self = shared_from_this()](const Error &error, std::size_t) {
        if (error)
          {
            self->leave();
            return;
          }
        const std::string message = beast::buffers_to_string(self->buffer.data());
        self->buffer.consume(self->buffer.size());
        if (!self->stream.got_text())
          self->close(websocket::close_code::bad_payload, "only texts are understood");
        else
          self->take(message);
        self->read();
      });
    }

    void
    take(const std::string &message)
    {
      if (message == "a")
        {
          credit = std::min(credit + 1, most_credit);
          mailbox.set_credit(credit);
          write();
          return;
        }
      const Mailbox::Request request = request_of(message);
      if (request.number == 0)
        close(websocket::close_code::policy_error, "a request is NUMBER COMMAND");
      else if (!mailbox.put_request(request))
        close(websocket::close_code::try_again_later, "too many requests");
    }

    template <class Buffer>
    void
    send(const Buffer &content, const bool is_text)
    {
      writing = true;
      stream.text(is_text);
      stream.async_write(content, [self = shared_from_this()](const Error &error, std::size_t) {
        self->writing = false;
        if (error)
          self->leave();
        else
          self->write();
      });
    }

    /** The page has gone: another one may come. */
    void
    leave()
    {
      if (std::exchange(open, false))
        mailbox.set_present(false);
    }

    websocket::stream<beast::tcp_stream> stream;
    beast::flat_buffer buffer;
    Mailbox &mailbox;
    unsigned int credit = 0; ///< frames that the page is ready for
    bool open = false, writing = false, closing = false;
    std::deque<std::string> texts;
    std::string text;     ///< that is being sent
    Mailbox::Bytes frame; ///< that is being sent
  };


  /** What one connection asks for before it is a socket. */
  class LiveConnection : public std::enable_shared_from_this<LiveConnection>
  {
  public:
    /** @param upgrade takes the connection over as a socket */
    using Upgrade = std::function<void(tcp::socket &&, HttpRequest &&)>;
    using Answer  = std::function<HttpAnswer(const HttpRequest &)>;

    LiveConnection(tcp::socket socket, Answer answer, Upgrade upgrade)
      : stream(std::move(socket))
      , answer(std::move(answer))
      , upgrade(std::move(upgrade))
    {
    }

    void
    start()
    {
      parser.emplace();
      parser->header_limit(longest_head);
      parser->body_limit(longest_request);
      stream.expires_after(patience);
      http::async_read(stream,
                       buffer,
                       *parser,
                       [self = shared_from_this()](const Error &error, std::size_t) {
                         if (!error)
                           self->take();
                       });
    }

  private:
    void
    take()
    {
      HttpRequest request = parser->release();
      response            = answer(request);
      if (response.result() == http::status::switching_protocols)
        {
          upgrade(stream.release_socket(), std::move(request));
          return;
        }
      response.prepare_payload();
      http::async_write(stream, response, [self = shared_from_this()](const Error &, std::size_t) {
        Error ignored;
        self->stream.socket().shutdown(tcp::socket::shutdown_send, ignored);
      });
    }

    beast::tcp_stream stream;
    beast::flat_buffer buffer;
    std::optional<http::request_parser<http::string_body>> parser;
    HttpAnswer response;
    const Answer answer;
    const Upgrade upgrade;
  };


  class LiveServer::Thread
  {
  public:
    Thread(Mailbox &mailbox, LiveContent of_session)
      : mailbox(mailbox)
      , content(std::move(of_session))
      , acceptor(io)
      , token(random_token())
    {
      try
        {
          const tcp::endpoint loopback(asio::ip::address_v4::loopback(), 0);
          acceptor.open(loopback.protocol());
          acceptor.bind(loopback);
          acceptor.listen();
          host = "127.0.0.1:" + std::to_string(acceptor.local_endpoint().port());
        }
      catch (const boost::system::system_error &error)
        {
          throw InputError(std::string("--live: no port of 127.0.0.1 can be had: ") + error.what() +
                           ".");
        }
      content.page   = with_connection(std::move(content.page), host);
      mailbox.notify = [this] {
        asio::post(io, [this] {
          if (const auto open = socket.lock())
            open->write();
        });
      };
      accept();
      worker = std::thread([this] { io.run(); });
    }

    ~Thread()
    {
      mailbox.notify = [] {};
      asio::post(io, [this] {
        Error ignored;
        acceptor.close(ignored);
        soon.cancel();
        if (const auto open = socket.lock())
          open->close(websocket::close_code::going_away, "the session has ended");
        // whoever does not answer is not waited for
        last_moments.expires_after(std::chrono::seconds(1));
        last_moments.async_wait([this](const Error &) { io.stop(); });
      });
      worker.join();
    }

    std::string
    address() const
    {
      return "http://" + host + "/?token=" + token;
    }

  private:
    void
    accept()
    {
      acceptor.async_accept([this](const Error &error, tcp::socket connected) {
        if (error == asio::error::operation_aborted || !acceptor.is_open())
          return;
        if (!error)
          std::make_shared<LiveConnection>(
            std::move(connected),
            [this](const HttpRequest &request) { return answer(request); },
            [this](tcp::socket &&upgraded, HttpRequest &&request) {
              const auto open = std::make_shared<LiveSocket>(std::move(upgraded), mailbox);
              socket          = open;
              open->start(std::move(request));
            })
            ->start();
        if (!error)
          {
            accept();
            return;
          }
        // There may be no descriptors left: in a moment there may be.
        soon.expires_after(std::chrono::milliseconds(100));
        soon.async_wait([this](const Error &stopped) {
          if (!stopped)
            accept();
        });
      });
    }

    HttpAnswer
    refusal(const HttpRequest &request, const http::status status, const std::string &why) const
    {
      HttpAnswer answer{status, request.version()};
      answer.set(http::field::content_type, "text/plain; charset=utf-8");
      answer.keep_alive(false);
      answer.body() = why + "\n";
      return answer;
    }

    HttpAnswer
    answer(const HttpRequest &request) const
    {
      const std::string target(request.target());
      const auto question     = target.find('?');
      const std::string path  = target.substr(0, question);
      const std::string query = question == std::string::npos ? "" : target.substr(question + 1);
      const std::string named = "token=";
      const auto forbid       = [&](const std::string &why) {
        return refusal(request, http::status::forbidden, why);
      };
      if (request[http::field::host] != host)
        return forbid("This server is " + host + " and no other.");
      if (query.rfind(named, 0) != 0 || !are_equal(query.substr(named.size()), token))
        return forbid("The token of this session is missing or wrong.");
      if (request.method() != http::verb::get)
        return refusal(request, http::status::method_not_allowed, "Only GET is understood.");
      if (path == "/socket" && websocket::is_upgrade(request))
        {
          if (request[http::field::origin] != "http://" + host)
            return forbid("The socket is for the page of this session alone.");
          if (!socket.expired())
            return forbid("Another page has this session.");
          return HttpAnswer{http::status::switching_protocols, request.version()};
        }
      HttpAnswer page{http::status::ok, request.version()};
      page.keep_alive(false);
      page.set(http::field::cache_control, "no-store");
      page.set("Referrer-Policy", "no-referrer");
      page.set("X-Content-Type-Options", "nosniff");
      page.set("X-Frame-Options", "DENY");
      if (path == "/")
        {
          page.set(http::field::content_type, "text/html; charset=utf-8");
          page.body() = content.page;
        }
      else if (path == "/surface")
        {
          page.set(http::field::content_type, "application/octet-stream");
          page.body() = content.surface;
        }
      else
        return refusal(request, http::status::not_found, "There is no such page.");
      return page;
    }

    Mailbox &mailbox;
    LiveContent content;
    asio::io_context io{1};
    tcp::acceptor acceptor;
    asio::steady_timer last_moments{io}, soon{io};
    const std::string token;
    std::string host;
    std::weak_ptr<LiveSocket> socket;
    std::thread worker;
  };


  LiveServer::LiveServer(Mailbox &mailbox, LiveContent content)
    : thread(std::make_unique<Thread>(mailbox, std::move(content)))
  {
  }


  LiveServer::~LiveServer() = default;


  std::string
  LiveServer::address() const
  {
    return thread->address();
  }

} // namespace Supple
