"""The pages in a browser, on a wide screen and on a telephone: nothing clipped, nothing fetched, time can be moved."""

from __future__ import annotations

import json

import numpy as np
import pytest

from dolfinrod.groove import Scenario, report
from tests.groove.films import FRAMES, helices, twisted

pytestmark = [pytest.mark.serial, pytest.mark.slow]

WIDE, PHONE = 1300, 400
# WebGL by the processor: there is no graphics card.
WORDS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
# How far from the top the verdict may reach [px].
FIRST_SCREEN = 900
READY = 180.0

CLIPPED = """
return [...document.querySelectorAll('table, figure, img, li, p, h1, h2, h3, .verdict')].filter(e =>
  !e.closest('.scroll') && e.getBoundingClientRect().right > innerWidth + 1).map(e => e.outerHTML.slice(0, 120));
"""
SCROLLED = """
return [...document.querySelectorAll('table')].filter(t => {
  const box = t.closest('.scroll');
  return !(box && getComputedStyle(box).overflowX == 'auto');
}).length;
"""
UNLOADED = "return [...document.querySelectorAll('img')].filter(i => !i.complete || !i.naturalWidth).length;"
# Mean place of the points of a fibre.
MIDDLE = """
const trace = document.getElementById('bundles').data.find(t => t.name === arguments[0]);
return ['x', 'y', 'z'].map(c => trace[c].reduce((a, b) => a + b, 0) / trace[c].length);
"""
MOVE = """
const slider = document.getElementById('time');
slider.value = arguments[0];
slider.dispatchEvent(new Event('input'));
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A report of strands of known twist, in which the lateral one moves from frame to frame."""
    from dolfinrod.groove import Folder

    path = tmp_path_factory.mktemp("groove")
    kept = Folder(path)
    for kind in ("lateral", "intermediate"):
        for run in twisted(path, Scenario(kind, fibres=5), range(3)):
            arrays = kept.arrays(run.key)
            moved = arrays["paths"].copy()
            moved[..., 2] += 1e-4 * (FRAMES - 1 - arrays["times"] / 1e-3)[:, None, None]
            kept.write(run, arrays | {"paths": moved})
    report(path)
    return path


@pytest.fixture(scope="module", params=[WIDE, PHONE], ids=["wide", "phone"])
def browser(request):
    """Headless Chromium that keeps a record of what it fetches."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    for word in WORDS:
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    screen = {"width": request.param, "height": 900, "deviceScaleFactor": 1, "mobile": request.param == PHONE}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
    driver.set_script_timeout(READY)
    yield driver
    driver.quit()


def fetched(browser) -> list[str]:
    """Addresses asked for since this was last called, those within the page left out."""
    messages = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    sent = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
    return [url for url in sent if not url.startswith(("data:", "blob:"))]


def complaints(browser) -> list[str]:
    """Of the console; that a picture is read back slowly concerns nobody."""
    return [entry["message"] for entry in browser.get_log("browser") if "willReadFrequently" not in entry["message"]]


def test_the_page_fits_the_screen_and_is_whole(browser, folder):
    fetched(browser)
    browser.get((folder / "index.html").as_uri())
    assert fetched(browser) == [(folder / "index.html").as_uri()]
    width, seen = browser.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
    assert width <= seen
    assert browser.execute_script(CLIPPED) == []
    assert browser.execute_script(SCROLLED) == 0
    assert browser.execute_script(UNLOADED) == 0
    assert complaints(browser) == []
    if seen == WIDE:
        bottom = browser.execute_script("return document.querySelector('.verdict').getBoundingClientRect().bottom")
        assert bottom <= FIRST_SCREEN


def test_bundles_move_with_the_slider_offline(browser, folder):
    from selenium.webdriver.support.ui import WebDriverWait

    fetched(browser)
    page = folder / "three.html"
    browser.get(page.as_uri())
    wait = WebDriverWait(browser, READY)
    wait.until(lambda b: b.execute_script("return document.body.dataset.ready") == "yes")
    width, seen = browser.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
    assert width <= seen
    assert browser.execute_script("return document.getElementById('time').max") == str(FRAMES - 1)
    # The middle fibre of a strand is straight; its tube is centred on it.
    straight = 1e3 * helices(1.2, 5)[2].mean(axis=0)
    assert browser.execute_script(MIDDLE, "fibre 3") == pytest.approx(straight, abs=1e-4)
    browser.execute_script(MOVE, 0)
    wait.until(lambda b: b.execute_script("return document.getElementById('told').value") == "t = 0.000 ms")
    moved = np.add(straight, (0.0, 0.0, 0.1 * (FRAMES - 1)))
    assert browser.execute_script(MIDDLE, "fibre 3") == pytest.approx(moved, abs=1e-4)
    browser.execute_script("document.getElementById('play').click()")
    wait.until(lambda b: b.execute_script("return document.getElementById('play').textContent") == "Play")
    assert browser.execute_script(MIDDLE, "fibre 3") == pytest.approx(straight, abs=1e-4)
    assert fetched(browser) == [page.as_uri()]
    assert complaints(browser) == []


def test_space_is_right_handed_as_drawn(folder):
    text = (folder / "three.html").read_text(encoding="utf-8")
    figure = json.loads(text.split('id="figure">')[1].split("</script>")[0])
    for name in ("scene", "scene2"):
        scene = figure["layout"][name]
        assert scene["camera"]["up"] == {"x": 0, "y": 1, "z": 0}
        assert all(scene[f"{axis}axis"]["range"][0] < scene[f"{axis}axis"]["range"][1] for axis in "xyz")
        (bottom, top), (left, right) = scene["yaxis"]["range"], scene["zaxis"]["range"]
        ratio = scene["aspectratio"]
        assert ratio["y"] / (top - bottom) == pytest.approx(ratio["z"] / (right - left))
