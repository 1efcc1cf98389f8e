// The secret of this page: without it the server answers with nothing but the page itself.

const secret = {
  /** Where a browser keeps it: for pages of this address and port alone, unlike a cookie. */
  NAME: "tribodyn-secret",
  given: document.querySelector('meta[name="secret"]').content,

  /** Return what this browser keeps, or else what this page was given. */
  now() {
    try {
      return localStorage.getItem(secret.NAME) || secret.given;
    } catch {
      return secret.given; // this browser keeps nothing
    }
  },

  /** Keep what was given, and take the token that brought it out of the address. */
  keep() {
    if (!secret.given) return;
    try {
      localStorage.setItem(secret.NAME, secret.given);
    } catch {
      // then it lasts as long as this page
    }
    history.replaceState(history.state, "", location.pathname + location.hash);
  },

  /** Say what to do without it: the server has given its only one away. */
  lost() {
    showError("This browser has lost the secret of this workbench: start the workbench again.", 2);
  },
};

secret.keep();
