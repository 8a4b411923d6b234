//! A headless Chromium, driven through `WebDriver`.

#![allow(
    dead_code,
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "each test takes some of it; what fails here fails a test"
)]

mod http;

use serde_json::{Value, json};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];
const DRIVER: &str = "chromedriver";
const ARGUMENTS: [&str; 9] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
];

/// A browser with one window; it ends with the value.
pub(crate) struct Browser {
    driver: Child,
    port: u16,
    session: String,
    folder: PathBuf,
}

impl Browser {
    /// Starts one, or says why not. `DSR_BROWSER=required` makes that a failure.
    pub(crate) fn start(width: u32, height: u32) -> Option<Self> {
        let browser = BROWSERS.iter().find_map(|name| found(name));
        let (Some(browser), Some(driver)) = (browser, found(DRIVER)) else {
            let why = "skipped: there is no browser; install chromium and chromium-driver";
            assert!(std::env::var("DSR_BROWSER").as_deref() != Ok("required"), "{why}");
            println!("{why}");
            return None;
        };
        Some(Self::of(&browser, &driver, width, height))
    }

    fn of(browser: &Path, driver: &Path, width: u32, height: u32) -> Self {
        static NUMBER: AtomicUsize = AtomicUsize::new(0);
        let number = NUMBER.fetch_add(1, Relaxed);
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
            .join(format!("browser-{}-{number}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let mut driver = Command::new(driver)
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let lines = BufReader::new(driver.stdout.take().unwrap()).lines();
        let port = lines
            .map_while(Result::ok)
            .find_map(|line| line.split_once("successfully on port ")?.1.trim_end_matches('.').parse().ok())
            .expect("the driver says on which port it listens");
        let mut arguments: Vec<String> = ARGUMENTS.iter().map(ToString::to_string).collect();
        arguments.push(format!("--user-data-dir={}", folder.join("profile").display()));
        arguments.push(format!("--window-size={width},{height}"));
        let wanted = json!({ "capabilities": { "alwaysMatch": {
            "browserName": "chrome",
            "goog:chromeOptions": { "binary": browser, "args": arguments },
            "goog:loggingPrefs": { "browser": "ALL", "performance": "ALL" },
        }}});
        let mut started = Self { driver, port, session: String::new(), folder };
        let answer = http::request(port, "POST", "/session", &wanted).unwrap();
        started.session = answer["sessionId"].as_str().unwrap().into();
        // The least width of a window is more than that of a telephone.
        started.size(width, height);
        started
    }

    fn post(&self, path: &str, body: &Value) -> Value {
        http::request(self.port, "POST", &format!("/session/{}/{path}", self.session), body).unwrap()
    }

    /// Makes the page this wide and high.
    pub(crate) fn size(&self, width: u32, height: u32) {
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.devtools("Emulation.setDeviceMetricsOverride", &metrics);
    }

    /// Prefers light or dark.
    pub(crate) fn prefer(&self, scheme: &str) {
        let features = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        self.devtools("Emulation.setEmulatedMedia", &features);
    }

    /// A command of the developer tools.
    pub(crate) fn devtools(&self, command: &str, parameters: &Value) -> Value {
        self.post("goog/cdp/execute", &json!({ "cmd": command, "params": parameters }))
    }

    /// Writes a page to a file of its own and opens it there, as for the first time.
    pub(crate) fn open(&self, page: &str, fragment: &str) -> String {
        let file = self.folder.join("page.html");
        std::fs::write(&file, page).unwrap();
        let url = format!("file://{}", file.display());
        self.post("url", &json!({ "url": "about:blank" }));
        // What the browser's own first page has asked for is not ours.
        self.requests();
        self.post("url", &json!({ "url": format!("{url}{fragment}") }));
        // Until the page is painted and has the focus, keys go nowhere.
        self.devtools("Emulation.setFocusEmulationEnabled", &json!({ "enabled": true }));
        self.run("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
        url
    }

    /// A browser with this page open.
    pub(crate) fn opened(page: &str, fragment: &str) -> Option<Self> {
        let browser = Self::start(1400, 900)?;
        browser.open(page, fragment);
        Some(browser)
    }

    /// The text of the first element of a selector.
    pub(crate) fn text(&self, selector: &str) -> String {
        let text = self.run(&format!("return document.querySelector({selector:?}).textContent"));
        text.as_str().unwrap_or_default().into()
    }

    /// The address's fragment.
    pub(crate) fn hash(&self) -> String {
        self.run("return location.hash").as_str().unwrap().into()
    }

    /// The step that is shown.
    pub(crate) fn step(&self) -> i64 {
        self.run("return Number(document.querySelector('#slider').value)").as_i64().unwrap()
    }

    /// Goes to another fragment of the open page.
    pub(crate) fn go(&self, fragment: &str) {
        self.post("execute/async", &json!({
            "script": "const [to, done] = arguments; if (location.hash === to || (to === '#' && location.hash === '')) return done(); \
                addEventListener('hashchange', () => setTimeout(done), { once: true }); location.hash = to;",
            "args": [fragment],
        }));
    }

    /// The value of a function body.
    pub(crate) fn run(&self, script: &str) -> Value {
        self.post("execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// Waits until what has been started, such as a change of the fragment, has come to pass.
    pub(crate) fn settle(&self) {
        self.run("return new Promise((done) => setTimeout(done, 150))");
    }

    /// Presses and releases a key.
    pub(crate) fn press(&self, key: &str) {
        let key = match key {
            "ArrowLeft" => "\u{e012}",
            "ArrowRight" => "\u{e014}",
            "Home" => "\u{e011}",
            "End" => "\u{e010}",
            "Escape" => "\u{e00c}",
            "Tab" => "\u{e004}",
            letter => letter,
        };
        let strokes = json!([{ "type": "keyDown", "value": key }, { "type": "keyUp", "value": key }]);
        self.post("actions", &json!({ "actions": [{ "type": "key", "id": "keys", "actions": strokes }] }));
    }

    /// Clicks in the middle of the first element of a selector.
    pub(crate) fn click(&self, selector: &str) {
        let element = self.post("element", &json!({ "using": "css selector", "value": selector }));
        let id = element.as_object().unwrap().values().next().unwrap().as_str().unwrap();
        self.post(&format!("element/{id}/click"), &json!({}));
        self.settle();
    }

    /// What the console has said since this was asked last.
    pub(crate) fn console(&self) -> Vec<String> {
        let entries = self.post("se/log", &json!({ "type": "browser" }));
        entries.as_array().unwrap().iter().map(|entry| entry["message"].as_str().unwrap().into()).collect()
    }

    /// The addresses that were asked for since this was asked last.
    pub(crate) fn requests(&self) -> Vec<String> {
        let entries = self.post("se/log", &json!({ "type": "performance" }));
        let events = entries.as_array().unwrap().iter().map(|entry| {
            serde_json::from_str::<Value>(entry["message"].as_str().unwrap()).unwrap()["message"].clone()
        });
        let sent = events.filter(|event| event["method"] == "Network.requestWillBeSent");
        sent.map(|event| event["params"]["request"]["url"].as_str().unwrap().into()).collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = http::request(self.port, "DELETE", &format!("/session/{}", self.session), &json!({}));
        let _ = self.driver.kill();
        let _ = self.driver.wait();
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

fn found(program: &str) -> Option<PathBuf> {
    let paths = std::env::var_os("PATH")?;
    std::env::split_paths(&paths).map(|folder| folder.join(program)).find(|path| path.is_file())
}
