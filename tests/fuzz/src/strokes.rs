//! What sessions of random keys press: all that writes no file, in the order in which bytes choose it.

/// Keys of the explorer, of lists and of lines.
pub const KEYS: &str = "<Space> . , m M w W + - = <Tab> <S-Tab> z v V p e c C [ ] r L t T x i I f g G n o O \
    h j k l <Left> <Right> <Up> <Down> <Enter> <Esc> ? / : <Home> <End> <PageUp> <PageDown> <Delete> <Backspace> \
    <C-u> <C-w> <C-n> <C-p> <C-l> <lt> 1 5 0 é ∂ ~";

/// What comes now and then: other sizes, pastes, and commands that are typed as a whole.
pub const RARE: &[&str] = &[
    ",,",
    "a",
    ">",
    "<resize:80x24>",
    "<resize:30x9>",
    "<resize:1x1>",
    "<resize:200x60>",
    "<paste:numerics.points=12>",
    "<paste:load cone>",
    "<paste:set numerics.points = 12\u{2202}>",
    "<Esc>:set numerics.method=a<Enter>",
    "<Esc>:set numerics.points=33<Enter>",
    "<Esc>:set wear.coefficient=0<Enter>",
    "<Esc>:set motion.tangential.amplitude=0<Enter>",
    "<Esc>:set friction.coefficient=1e9<Enter>",
    "<Esc>:set motion.normal.mean=-1<Enter>",
    "<Esc>:load cone<Enter>",
    "<Esc>:load flat-punch<Enter>",
];
