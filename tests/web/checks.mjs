// Named checks, counted: one that fails does not stop the others.
let failures = 0;

export async function check(name, body) {
  try {
    await body();
    console.log(`passed  ${name}`);
  } catch (error) {
    fail(`${name}\n${error.message}`);
  }
}

export function fail(text) {
  ++failures;
  console.log(`FAILED  ${text.split("\n").join("\n        ")}`);
}

// Says how many failed, in words and as the exit status.
export function conclude() {
  console.log(failures === 0 ? "all passed" : `${failures} failed`);
  process.exitCode = failures === 0 ? 0 : 1;
}
