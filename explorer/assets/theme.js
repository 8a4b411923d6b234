// Light, dark, or as the system is.

const THEMES = ["system", "light", "dark"];

// The choice is kept where the browser lets a file keep something.
function theme(wanted) {
  try {
    if (wanted !== undefined) localStorage.setItem("dsr-theme", wanted);
    return localStorage.getItem("dsr-theme");
  } catch {
    return null;
  }
}

function turnTheme() {
  const now = document.documentElement.dataset.theme ?? "system";
  setTheme(THEMES[(THEMES.indexOf(now) + 1) % THEMES.length]);
}

function setTheme(wanted) {
  const known = THEMES.includes(wanted) ? wanted : "system";
  document.documentElement.dataset.theme = known;
  document.getElementById("theme").textContent = known;
  theme(known);
}
