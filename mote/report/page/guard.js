// A report must never fail in silence: whatever goes wrong in a script is said on the page.
(() => {
  const tell = (what) => {
    let box = document.getElementById("page-error");
    if (!box) {
      box = document.createElement("p");
      box.id = "page-error";
      box.className = "error";
      box.setAttribute("role", "alert");
      document.querySelector("main").prepend(box);
    }
    box.textContent = `A script of this page failed, charts may be missing: ${what}`;
  };
  addEventListener("error", (event) => tell(event.message));
  addEventListener("unhandledrejection", (event) => tell(event.reason));
})();
