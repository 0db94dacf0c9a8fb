from benchmarks.studio import _alive as alive, _browser as launcher, _kill_browser as chromium_killed, _linked as linked, _opened as opened, _page as shown_page
