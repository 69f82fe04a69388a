# Comments of this library use no HTML: <L> in one is a template's argument.
/^ *\/\/\//s/<([A-Za-z]+)>/\\<\1\\>/g
