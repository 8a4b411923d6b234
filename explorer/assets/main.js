// Starts the page.

help();
setTheme(theme());
document.getElementById("theme").addEventListener("click", turnTheme);
document.addEventListener("keydown", press);
addEventListener("hashchange", navigate);
navigate();
