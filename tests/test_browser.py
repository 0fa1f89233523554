"""The report in a browser, on a wide screen and on a telephone: nothing clipped, nothing broken, all of it legible."""

from __future__ import annotations

import subprocess
import sys

import pytest

pytestmark = [pytest.mark.serial, pytest.mark.slow]

WIDE, PHONE = 1600, 390
SMALLEST_TEXT = 11.0
# Most bytes of the page.
HEAVIEST = 8e6

CLIPPED = """
return [...document.querySelectorAll('table, pre, dl, figure, .verdict, summary, p, h1, h2, h3')].filter(e => {
  const box = e.closest('.scroll') || document.documentElement;
  return box.getBoundingClientRect().right > innerWidth + 1 ||
         (!e.closest('.scroll') && e.getBoundingClientRect().right > innerWidth + 1);
}).map(e => e.outerHTML.slice(0, 120));
"""
SCROLLED = """
return [...document.querySelectorAll('table')].filter(t => {
  const box = t.closest('.scroll');
  return t.scrollWidth > t.parentElement.clientWidth && !(box && getComputedStyle(box).overflowX == 'auto');
}).length;
"""
DEAD_LINKS = """
return [...document.querySelectorAll('a[href^="#"]')].map(a => a.getAttribute('href').slice(1))
  .filter(id => !document.getElementById(id));
"""
FIGURES = """
return [...document.querySelectorAll('figure svg')].map(e => {
  const box = e.getBoundingClientRect();
  return [box.width, box.height];
});
"""
TEXTS = """
const found = [];
const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
while (walker.nextNode()) {
  const e = walker.currentNode.parentElement;
  if (!walker.currentNode.data.trim() || ['SCRIPT', 'STYLE', 'TITLE', 'title'].includes(e.tagName)) continue;
  const scale = e.ownerSVGElement ? e.getScreenCTM().a : 1;
  found.push([scale * parseFloat(getComputedStyle(e).fontSize), walker.currentNode.data.trim().slice(0, 40)]);
}
return found;
"""
# Letters of a figure that leave its frame.
OUTSIDE = """
return [...document.querySelectorAll('figure svg')].flatMap(svg => {
  const frame = svg.getBoundingClientRect();
  return [...svg.querySelectorAll('text, circle, polyline, path')].filter(t => {
    const box = t.getBoundingClientRect();
    return box.left < frame.left - 1 || box.right > frame.right + 1 ||
           box.top < frame.top - 1 || box.bottom > frame.bottom + 1;
  }).map(t => t.outerHTML.slice(0, 120));
});
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The report of a quick run over one case a family, the laws, and a few trials of every kind."""
    from verification import trials
    from verification.plan import LAWS, headlines

    folder = tmp_path_factory.mktemp("report")
    short = (name for name in trials.names() if name not in trials.APART)
    words = ["verify", *headlines(), LAWS, *short, "--quick", "--out", str(folder)]
    done = subprocess.run([sys.executable, "-m", "dolfinrod.cli", *words], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    return folder / "index.html"


@pytest.fixture(scope="module", params=[WIDE, PHONE], ids=["wide", "phone"])
def browser(request, page):
    """Headless Chromium that shows the page with every case unfolded."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    screen = {"width": request.param, "height": 1000, "deviceScaleFactor": 1, "mobile": request.param == PHONE}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
    driver.get(page.as_uri())
    driver.execute_script("for (const fold of document.querySelectorAll('details')) fold.open = true;")
    yield driver
    driver.quit()


def test_console_is_silent(browser):
    assert browser.get_log("browser") == []


def test_page_is_light(page):
    assert page.stat().st_size < HEAVIEST


def test_page_is_as_wide_as_the_screen(browser):
    width, shown = browser.execute_script(
        "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]"
    )
    assert width <= shown
    assert browser.execute_script(CLIPPED) == []


def test_tables_that_are_wider_scroll_in_their_own_box(browser):
    assert browser.execute_script("return document.querySelectorAll('table').length") > 10
    assert browser.execute_script(SCROLLED) == 0


def test_every_link_within_the_page_has_its_target(browser):
    assert browser.execute_script("return document.querySelectorAll('a[href^=\"#\"]').length") > 20
    assert browser.execute_script(DEAD_LINKS) == []


def test_a_link_unfolds_the_case_it_leads_to(browser):
    browser.execute_script("for (const fold of document.querySelectorAll('details')) fold.open = false;")
    browser.execute_script("location.hash = document.querySelector('details.case').id; unfold();")
    assert browser.execute_script("return document.querySelector('details.case').open")
    browser.execute_script("for (const fold of document.querySelectorAll('details')) fold.open = true;")


def test_every_figure_is_seen_and_holds_all_that_it_draws(browser):
    sizes = browser.execute_script(FIGURES)
    assert len(sizes) > 10
    assert min(min(size) for size in sizes) > 100.0
    assert browser.execute_script(OUTSIDE) == []


def test_text_is_legible(browser):
    texts = browser.execute_script(TEXTS)
    assert len(texts) > 500
    assert [text for text in texts if text[0] < SMALLEST_TEXT] == []


def test_the_verdict_is_on_the_first_screen(browser):
    script = "return document.querySelector('.said').getBoundingClientRect().bottom + scrollY"
    assert browser.execute_script(script) < 1000
