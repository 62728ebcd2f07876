"""Headless Chromium for the tests of pages: where it is, what a page answers, and a picture of it."""
import http.server
import queue
import shutil
import subprocess
import tempfile
import threading

FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"]


def find():
    return next((b for b in ("chromium", "chromium-browser", "google-chrome") if shutil.which(b)), None)


def answer_of(browser, url_for, *, size=(1200, 800), timeout=300):
    """What the page posts: url_for(address) is the page's, which sends its answer there by fetch(address, {method: "POST", mode: "no-cors", body}).

    In the page's own time: frames last what they last.
    """
    answers = queue.Queue()

    class Mailbox(http.server.BaseHTTPRequestHandler):
        def do_POST(self):
            answers.put(self.rfile.read(int(self.headers["Content-Length"])).decode())
            self.send_response(204)
            self.end_headers()

        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Mailbox)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile, tempfile.TemporaryFile("w+") as words:
        url = url_for(f"http://127.0.0.1:{server.server_address[1]}/")
        page = subprocess.Popen([browser, *FLAGS, "--remote-debugging-port=0", f"--window-size={size[0]},{size[1]}", f"--user-data-dir={profile}", url],
                                stdout=words, stderr=words)
        try:
            return answers.get(timeout=timeout)
        except queue.Empty:
            words.seek(0)
            raise TimeoutError(f"the page has not answered in {timeout} s: {words.read()[-2000:]}") from None
        finally:
            page.terminate()
            page.wait()
            server.shutdown()


def picture_of(browser, url, path, *, seconds=10, size=(1200, 800), timeout=120):
    """A picture of the page once it has run for so many seconds of its own clock, which stands while it works."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        subprocess.run([browser, *FLAGS, f"--virtual-time-budget={1000 * seconds}", f"--window-size={size[0]},{size[1]}", f"--user-data-dir={profile}",
                        f"--screenshot={path}", url], capture_output=True, text=True, timeout=timeout, check=True)
